#include <tactile_net/simulator/ngspice_library.hpp>

int main() {
  tactile_net::NgspiceLibrary ngspice;
  const auto plot = ngspice.run("* one volt\nR1 a 0 1\nI1 0 a 1\n.op\n.end\n").plot;
  return plot.vector("v(a)").front() == 1.0 ? 0 : 1;
}
