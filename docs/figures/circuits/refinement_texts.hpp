/// @file
/// What docs/circuits.md says of refinement.
#pragma once

namespace tactile_net::circuits {

constexpr const char* refinement_text =
    R"(## Refined in numbers

A board of 1 % errs by 1 %. `certify --refine bits=12,cycles=4`, or `refine = { bits = 12 }` in the scene's [`network`](scene.md#network), says how far the same board comes as the inner solver of a refinement: what is left of the
equations goes back into its summing nodes through converters, and its answer d to that is added.

    f = the circuit's answer to the readings                                  cycle 1
    r = K'(g - K f) - R f                                                     in numbers
    d = the circuit's answer to currents r at the summing nodes, the readings' inputs at rest
    w = r'd / d'P d,  f += w d                                                cycle 2, 3, ...

**It is no way to beat the digital frame.** A cycle takes more multiplications than the whole answer f = M g in numbers (3688 against 1681 for 41 taxels), and both of a channel's converters besides: who can compute r can compute f.
Neither latency nor energy nor price speak for it. It is (1) a *self-test*: the first step is the board's own error, measured with nothing but its converters; (2) a way for boards of *coarse cells*, programmed in six bits, which err
as much as parts of 1 % and have no better class; (3) the only way to six digits, since no list of parts delivers them (values of pairs 2e-4, offsets). `certify` prints all of it beside each other, with price (converters typically 1 to a summing node, 2 from an output) and time.

Converters have the largest value of a cycle as their range, so that their errors are a share of what is left: no bit, no offset and no noise of theirs ends the refinement, only the arithmetic of r does. The circuit's offset is that of its op-amps, over the largest voltage
of its answer. `step` says how far a cycle goes: `"search"` is w above, `"plain"` is w = 1, `"conjugate"` makes d P-orthogonal to those before. Cycle 1 has to take the readings through their own inputs: there errors of K' multiply the small g - K f; at the summing nodes they would multiply K'g.
Later cycles must not.

**T9.** Let X = P^-1/2 (P^ - P) P^-1/2, P^ what currents at the summing nodes see of the build (the Schur complement of S for the outputs). If |X| <= t in the 2-norm, a cycle leaves of the error's energy |e|_P (a) with w = 1 at most t/(1 - t),
if t < 1/2; (b) with w as above at most **t**, if t < 1; conjugate steps are never worse. *Proof.* With u = P^1/2 e and y = P^1/2 d: y = (I + X)^-1 u, so u = y + X y. (a) u - y = X (I + X)^-1 u. (b) r'd/d'P d = u'y/y'y is the w that makes
|u - w y| least, which is |u| times the sine of the angle between y and y + X y; as |X y| <= t |y|, that sine is at most t. Conjugate steps minimise over a space that holds d. *Converters* add to u and to y at most the shares q1 and q2 of their length: a vector of errors within a
step each is at most (1'|P^-1| 1)^1/2 steps in the first norm and (1'|P| 1)^1/2 in the second, a gain within g at most g | |P^-1/2| |P^1/2| |, and Gaussian noise sigma P^1/2 x at most sigma (|P^1/2|_F + 5.3 |P^1/2|) in all but one cycle in a million. So three angles add up at most, and the cycle leaves
the sine of asin t + asin q1 + asin q2. Q.E.D.

*t from tolerances.* Resistances within e are conductances within e/(1 - e) = c. With inner bars entry by entry and outer ones the 2-norm, z = min(| |K| |P^-1/2| |, | |K| | / lambda^1/2) and rho = min(| |P^-1/2| |R| |P^-1/2| |, | |R| | / lambda), lambda the least eigenvalue of P,

    crossbar                 t = c rho, of P in place of R
    least_squares, lattice   t = (1 + e) (2 c z + c^2 z^2) + e + c rho + m

*Proof.* |K P^-1/2| <= 1, since K'K <= P, and |dK P^-1/2| <= c z, since |A| <= B by entries gives |A| <= |B| in the 2-norm. A residual is held by a resistor, or a sum of conductances, D: D/D^ is within 1 +- e. The factors of K^' (D/D^) K^ multiply out. m is of the lattice alone: the voltage
that both inputs of an amplifier have is of first order in the errors, and so is what the inputs' difference takes from it: m is the product of both bounds over Q, what that voltage meets. Q is symmetric and its rows exceed what is beside their diagonal, so Q is at least their sums, of which errors leave (1 - e)/(1 + e)^2. Q.E.D.
So errors of K count as e/alpha^1/2, errors of P as e/alpha: why the crossbar fails where the lattice refines. Values of a series, steps of cells and the op-amps' gain are the same in every build: X of the printed circuit is computed and added.

*All but one build in a million.* To first order X is a sum of columns times rows, each times its resistor's own error. Uniform errors within e have moments of variance e^2/3 at most, so P(|X| > x) <= 2 N exp(-x^2/2v), v the larger norm of the sums of squares from either side (matrix Hoeffding; Tropp 2012). What is beyond first order is
products of dK, dK' and the common voltages, each bounded in the same way, and squares of errors. The *verdict* is `proven` (t and converters below 1), `proven_for_all_but_1e-6`, or `refused`: neither, or the circuit or one of the builds is unstable; builds alone never make it.

Builds are the boards of the other draws. The errors that conspire are found by ascent: signs of all of them and singular vectors of X in turn. Parts within 1 %, 12 bits, gains within .1 %, noise of 1e-3 of the range, op-amps of gain 1e6 without offset, steps by search; 200 builds, errors of 95 of 100 after each cycle:

)";

constexpr const char* refinement_numbers =
    R"(
*Bound* is of all builds and of all but one in a million; |X| of the median and the worst build, and of errors that conspire. In single precision the refinement ends at 2e-7 for alpha = 1e-3 and at 1e-6 for 1e-5, in double precision at 2e-15 and 6e-15. Of alpha = 1e-5 the crossbar is refused: most of its builds are unstable.

An op-amp's offset counts like noise, multiplied as the answer's own error is: 50 uV at 1 V are nothing at alpha = 1e-3, and as much as all the parts at 1e-5, where the lattice is then refused. Measure the board's answer at rest once, and subtract it, or take op-amps of 5 uV.

*As a self-test*: |w d|/|f| of the second cycle is the error of the circuit's own answer, within 1 % of itself at alpha = 1e-3 and 5 to 20 % at 1e-5. `certify --refine` prints the limit to accept, which 95 of 100 builds stay below: a controller with a converter to each summing node and one from each output rejects a board, and sees it age, without a reference.

*In ngspice*: `relax SCENE --refine bits=12,cycles=5` refines the first of those builds, with the same converters, a deck a cycle, and compares it with the build in numbers. `gen SCENE --refine K` writes cycle K's deck: the build with currents r at its summing nodes
(`Irefine`, as many times as large as makes the largest voltage that of the answer), or with the readings in cycle 1. Answers of circuits of ideal op-amps, or of finite gain, are within 1e-14 of their equations; of board.toml's, whose rails and slew are bent, within 3e-8:

| `relax SCENE --refine bits=12,cycles=5` | 1 | 2 | 3 | 4 | 5 |
|---|---|---|---|---|---|
| circuits/crossbar.toml, ngspice; numbers | 0.0288; 0.0288 | 9.7e-4; 9.7e-4 | 3.5e-5; 3.5e-5 | 1.51e-6; 1.51e-6 | 7.64e-8; 7.64e-8 |
| circuits/board.toml, ngspice; numbers | 0.00735; 0.00735 | 5.13e-5; 5.13e-5 | 5.63e-7; 5.65e-7 | 4.71e-9; 4.61e-9 | 5.24e-11; 4.90e-11 |

What is not covered: errors that resistors share, reels and temperature, cells with noise, lines with resistance, outputs that are not opposites, ladders and inverters; `certify` refuses them. Common-mode rejection and output resistances are left out of P^.

)";

}  // namespace tactile_net::circuits
