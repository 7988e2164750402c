/* A control loop in C99: 11_c_controller PLAN. 07_controller writes the plan. Prints what frames of
   a load that grows say of it; one of them is broken, and one comes after a taxel has died. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <tactile_net/tactile_net.h>

/* What 41 taxels, 0.5 mm apart and 1.5 mm deep, read below a line load at y = 0: stress_x, then
   shear_xy, by Johnson 1985, 2.2-2.3 [Pa]. */
static void read_sensors(double normal, double tangential, size_t taxels, double* readings) {
  const double pi = 3.14159265358979323846;
  const double pitch = 0.5e-3, x = 1.5e-3;
  for (size_t i = 0; i < taxels; ++i) {
    const double y = ((double)i - 0.5 * (double)(taxels - 1)) * pitch;
    const double r2 = x * x + y * y;
    const double share = 2.0 * x * (normal * x + tangential * y) / (pi * r2 * r2);
    readings[i] = share * x;
    readings[taxels + i] = share * y;
  }
}

int main(int count, char** arguments) {
  if (count != 2) {
    fprintf(stderr, "usage: %s PLAN\n", arguments[0]);
    return 2;
  }
  /* Before the loop, everything that allocates or takes long. */
  tactile_net_estimator* const estimator = tactile_net_load(TACTILE_NET_INTERFACE, arguments[1]);
  if (estimator == NULL) {
    fprintf(stderr, "%s\n", tactile_net_last_error());
    return 2;
  }
  const tactile_net_plan* const plan = tactile_net_plan_of(estimator);
  double* const readings = malloc(plan->readings * sizeof *readings);
  double* const tractions = malloc(plan->tractions * sizeof *tractions);
  if (readings == NULL || tractions == NULL) return 2;

  /* In the loop: no allocation, no lock, no system call. */
  int refused = 0;
  tactile_net_estimate contact;
  for (int frame = 0; frame < 4; ++frame) {
    read_sensors(0.5 * (frame + 1), 0.15 * (frame + 1), plan->readings / 2, readings);
    if (frame == 1) readings[20] = NAN;
    if (frame == 3 && !tactile_net_set_dead(estimator, 20)) return 1;
    const tactile_net_status status =
        tactile_net_update(estimator, readings, plan->readings, 0.001 * frame, tractions, &contact);
    if (status != TACTILE_NET_OK) {
      printf("frame %d is refused: %s\n", frame, tactile_net_status_name(status));
      ++refused;
    } else if (contact.contact) {
      printf(
          "frame %d: normal force %.2f N/m, tangential %.2f N/m, %.2f N/m left before it slips\n",
          frame, contact.normal_force, contact.tangential_force, contact.friction_margin);
    }
  }
  free(tractions);
  free(readings);
  tactile_net_destroy(estimator);
  return refused == 1 && contact.friction_margin > 0.0 ? 0 : 1;
}
