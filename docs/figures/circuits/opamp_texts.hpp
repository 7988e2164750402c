/// @file
/// What the page of circuits says of real op-amps and of moving contacts.
#pragma once

inline constexpr const char* opamps_text =
    R"(## Real op-amps

Each figure of a data sheet is a key of [`opamp`](scene.md#network), and counts in the deck, the state space and the certificate.

**At rest.** An offset v_i at amplifier i moves the answer as a current D_i v_i into row i: by P^-1 D v over the answer, to first order, so one over
`volts`; a bias current i_b by P^-1 i_b over siemens and volts. `certify` takes both from the circuit's own sparse equations (one adjoint solve), so from any
realisation: once with all op-amps alike, as the deck has them, and once of signs by chance, root mean square, as they are bought. A finite common-mode rejection counts where
inputs follow the nodes (nic, rail), like errors of resistors of 1/cmrr; inputs at ground, and the lattice's, have nothing in common. An output resistance
stands inside a loop of the op-amp's gain. Complementary outputs are held each other's opposite by a loop of their own, which is taken for ideal:
out = core - resistance (i_out - i_inv)/2. Two outputs without that loop are loaded differently, and err at any volts.

No theorem on stability includes output resistances, nor T1 and T2 a finite common-mode rejection, nor any but T0 capacitance across resistors: the certificate says so, and its poles decide.

**On a board.** `parasitic` is what copper and pads add, to ground `node` at every node that nothing drives, `input` at every input beside the op-amp's own
`input_capacitance`, `output` at every output, and `resistor` across every resistor (a 0402 with its pads has some 0.05 pF); `differential_capacitance` lies between an op-amp's inputs. All of them are
in the deck, the poles, the settling time and the noise, and cost nothing where they are absent. What loads an output is a pole in its loop as soon as the output has a resistance: 200 ohm and 100 pF are one at 8 MHz.
ngspice settles with all of them in the certificate's time within 5 % (`nic`, `rail`, `crossbar`, `least_squares`, its ladder, `lattice`), and the noise agrees within 3 %. A lattice of 41 taxels at 2 mS, with 10 pF at its inputs
and 20 pF at its residuals, has its slowest pole at +1.2e6 1/s, and grows so in ngspice; at 10 mS it is stable.

**Slew.** The core integrates a bent rate: x' = slew tanh(r/slew), r what the inputs ask for (a thousandth of r passes straight on, without which a simulator finds no
slope). The certificate's settling time then comes from these equations: a method of Rosenbrock's until no rate exceeds by a hundredth of the slew
what finite gain asks for at rest, the exact exponential from there on. Every settling time begins without readings, where offsets and bias currents hold the circuit.

**T8.** With any bend phi of the rates that is odd, increasing and bounded, the crossbar without capacitance, whatever phi_i of its amplifiers,
and the lattice with one phi and no capacitance come to their answer from everywhere; one pole, complementary outputs. *Proof.* Crossbar: with e = v - f and D s = P e
(s the inputs' voltages), v' = -phi(s), so V = e'P e/2 falls: V' = -s'D phi(s) = -sum D_i s_i phi_i(s_i) < 0 unless s = 0, which is e = 0. Lattice:
D~ s = (c H + w R) e with s the voltages between the inputs, D~ = (D_s - H(0))/2 and V = e'(c H + w R) e/2, so V' = -s'D~ phi(s). D~ is symmetric, and as phi is odd and increasing,
|s_i phi(s_j) + s_j phi(s_i)| <= s_i phi(s_i) + s_j phi(s_j): a pair of rows loses at most |D~_ij| of both. Rows of H sum to at most
1/(1 + c) of D_s, so D~ is strictly diagonally dominant, and V' < 0. P > 0, so V has no other minimum and grows to all sides. Q.E.D.
*Finite gain* A subtracts (W/A) e'P e of V' in both. In the lattice an output v_i at rest is held by a rate W v_i/A, phi at s_i = a_i, and about it phi is no longer odd: s counted from there, it is
psi_i(s) = phi(a_i + s) - phi(a_i). The deck's tanh makes psi_i(s)/phi(s) = (1 - t_i^2)/(1 + t_i tanh), within 1 +- |t_i|, t_i the share of the slew that holds the output. Since D~_ii >= (1 + c) sum_j |D~_ij|, V' < 0 as long as
(1 + t)/(1 - t) <= 1 + c: t <= c/(2 + c) = 2/3. A rest exists: v'(c H + w R) v > 0, and v'D~ phi^-1(W v/A) >= 0 by the same pairs. `certify` compares W |v|/A with two thirds of the slew: a gain of 1e3 is enough for most.
Of least_squares, nic and rail nothing is proven: their energies have parts that slewing couples.

**1/f noise.** With a `noise_corner` f_c the op-amps' noise has the density e^2 (1 + f_c/f). Its variance diverges at low frequencies, so it is integrated from w0 = 2 pi 0.1 Hz up:
what changes more slowly than in ten seconds is an offset. With Q = f_c (W e)^2/2 at the op-amps' states, its intensity at 1 Hz, and F = integral of Re (j w - A)^-1 dw/w from w0 on, the
covariance solves A X + X A' + 2 (F Q + Q F') = 0, and F = (-A)^-1 Re log(1 - j A/w0): exact, with one logarithm of the triangular factor that Lyapunov's equation has made already. In the deck it is the
difference of two diodes at 1 A, of which one has flicker noise. ngspice's `.noise` from 0.1 Hz on agrees within 3 %. With bandwidths of megahertz it hardly counts:
the classes below have none.

**Output current.** What an output carries at rest follows from the sparse equations: the currents of all resistors at it, at both outputs of a pair. Beyond `output_current` the certificate
names the op-amp and the volts at which it carries just that. Where an `output_resistance` r is given too, the deck limits it: a stage whose core is u above its output gives I tanh((1/r - k) u/I) + k u, k the
less of 1e-3/r and I/100 a volt, since without that rest of a slope an operating point would be anywhere; of complementary outputs each stage by itself, and the output is half the difference of both. ngspice settles
as these equations do within 5 %, and comes to rest where more is asked for than is given. Settling times of the certificate know no such limit; the current at rest is what it judges.

**A scale to take.** Noise, offsets and bias currents fall as 1/volts; volts end where a node reaches 0.8 of what the rail leaves (2 V where none is given: most amplifiers with two outputs have 5 V in all), where two full swings at the
slew are a fifth of the settling time, or where an output carries its `output_current`. More siemens lower the resistors' noise until the op-amps' own is left: the scale proposed is where both are equal, but no resistor below
1 kilo-ohm, and none at which the poles would not decay. The certificate proposes; the scene decides.

The classes of op-amps, alpha = 1e-3, 1 mS per unit (with the second poles and input capacitances of the classes):

)";

inline constexpr const char* motion_text =
    R"(## Moving loads

Readings that change steadily, g + g' t, are followed as they were `delay` ago: x settles at -A^-1 b(t) - A^-2 b', so the answer is behind by C A^-2 B g', and the delay is
|C A^-2 B g'| over |C A^-1 B g'|. `certify` takes g' from the scene's own contacts, moved along y, and says the delay, the speed at which it is 1 % of the
answer, and up to which frequency the slowest direction follows (its slowest pole; only loads that the stabiliser alone holds lie in it).
If the shape of the readings changes too, as when an edge passes a taxel, the lag is up to three times as large. ngspice agrees within 5 %, with a contact
that moves over the array in forty pieces at half that speed. A digital answer sampled and held at 1 kHz is up to 1 ms behind, however fast its arithmetic is.

Op-amps of gain 1e6 and 10 MHz, lengths in mm:

)";

inline constexpr const char* arrays_text =
    R"(## Programmable arrays

Programmed cells (memristors, floating gates, switched resistors) can replace soldered resistors: `bits`, `cell_noise` and `wire_resistance` in a scene's
[`tolerance`](scene.md#network). Complementary lines make the signs, so a cell holds |K_ij|.

**Steps.** Rounding the cells of K and K' to the same steps of the largest only changes the model: the circuit solves the rounded K's problem exactly, which costs about 2^-bits
at any alpha, 8 bits for some 3e-3. In lattice rows of small sums, those at the ends, have small cells, and so fewer steps: at alpha = 1e-5
it wants two to four bits more. P is what squares the condition number: the crossbar wants 14 to 16 bits at alpha = 1e-5, and is not even stable with few.

**Noise of cells** that is as large for small cells as for large ones (a share of the range) costs far more than parts within so many per cent of their value: K is mostly small
entries.

**Wires.** A row ends at a summing node and a line at an output, both at the corner of the first cell. What the ends see of each cell comes from the sparse network of all crossings,
and errs by about 1.5 N r G, G the largest row's conductance and r a segment's resistance, while that is below 5e-2. It falls with siemens, and hardly depends on alpha: wires scale K smoothly.
Where ends are at nodes that nothing drives, the residuals and inputs of `lattice` and the nodes of a `ladder`, an array is all the conductances that each two of its ends have between them, not its cells alone:
they come from the same sparse network, one solution an end, and are part of every draw. The arrays of `lattice` have twice the rows, and err by about 1.75 N r G, where G is four times as large in the first of them:
its answers err some six times as much as those of `least_squares` at the same siemens per unit, and want as many fewer of them.

**One array for many pads.** K in units of its largest column depends on pitch, depth, nu and what is read; E and the load's size do not enter. Reprogramming for another pad is
2 M N cells of least_squares and 4 M N of lattice, and costs no part; alpha is in the stabiliser alone, 3 N - 2 resistors (twice as many in lattice), which stay soldered: a bank of
them to switch for as many alphas. A crossbar's cells hold alpha too: N^2 of them anew for every alpha.

An array of 0.5 ohm a segment; noise of 0.5 % of the range; errors of the answer, medians of 200 builds:

)";
