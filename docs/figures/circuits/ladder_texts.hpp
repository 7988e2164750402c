/// @file
/// What docs/circuits.md says of least squares with a ladder, theorem and proof included.
#pragma once

namespace tactile_net::circuits {

inline constexpr const char* ladder_text =
    R"(### With a ladder

![Least squares with the tractions at nodes of a ladder](circuits/least_squares-ladder.svg)

Without it a main row holds rho R f as differences of large currents: R's entries are l^2/h^2 times what is left of them, and so are their errors. With
`ladder = true` resistors take the differences themselves. The main amplifiers deliver y, and hold K'e = rho d y with d half of R's least row sum. The tractions are
nodes that nothing drives: z leads from y_j to f_j, z |R_ij|/d between f_i and f_j, and z (R's row sum/d - 1) to ground, of which K's own load is part
(z is the smallest value for which the ground leg exceeds K's own load; a resistor supplies the difference. The ladder of -f is identical). Kirchhoff's law at f is R f = d y whatever the scale, so the
fixed point is K'(g - K f) = R f as before. A resistor to ground at each main row's input makes the totals D_f of all rows equal.

**T6L.** Complementary outputs, one bandwidth W_f of the main amplifiers and one, W_e, of the residuals': stable for every rho and every ratio of the two.
*Proof:* let G be the conductances of either half of the ladder, every load included, A = z G^-1, and K = K+ - K- by its entries' signs. G is symmetric and has no
entry above 0 beside its diagonal. A residual amplifier's input is at t_i = -e_i'/W_e while it moves, and the nodes feel it: f+- = +-A y + G^-1 K+-'t. So the rows of
the residuals are, about the fixed point,

    (D/W_e) e' = -K A y - g_e e,   D = D_e - K+ G^-1 K+' - K- G^-1 K-',

and those of the main amplifiers (D_f/W_f) y' = K'e - r y, r = rho d, D_f a number. D is symmetric; and as K+'1 and K-'1 are within what goes to ground, q = the largest
share of a node's total that does, below 1, has G^-1 K+-'1 <= q 1: rows of what is taken off D_e sum to at most q sum_j |K_ij|, so D >= g_e. Hence V = (y'A y D_f/W_f + e'D e/W_e)/2
is positive, and dV/dt = y'A K'e - e'K A y - r y'A y - g_e |e|^2 < 0: the coupling cancels because A is symmetric. A finite gain a adds D_f/a to r
and D/a to g_e. Q.E.D. (Where R couples some
tractions and not others, as of two components, z, d and D_f may differ from one group to the next: A's blocks commute with them.)

**With lag.** T6's condition holds with D for D_e and theta = |D^-1/2 K A^1/2 D_f^-1/2|_2: in A^1/2 y in place of y all of its proof stands. tau is the largest C/D (C over D's least
eigenvalue) + 1/W2, gamma the least of g_e's form over D's. *Capacitance c at the ladder's nodes* alone is a lag too: stable if

    4 theta^2 W_f tau < gamma,   tau = c times the larger of 1/(G's least eigenvalue) and of the largest x'(K+ G^-2 K+' + K- G^-2 K-')x / x'D x.

*Proof:* now f = A(p) y with A(p) = z (G + p c)^-1 is what K sees of y. In f the main rows are (p D_f/W_f + r)(G + p c)/z f = K'e, and in the residuals' D gains
N(p) = sum K+- (G^-1 - (G + p c)^-1) K+-', at p = jw of a real part that is not negative and an imaginary part of at most w c K+- G^-2 K+-'. So the coupling is skew again. New poles come in
from -G/c, so that one could only cross at p = jw. There the real part says w^2 m = s and the imaginary part |k| = w d, with s = r f*A^-1 f + g_e |e|^2, m = c/z D_f/W_f |f|^2 + e*(Im N/w)e/W_e, d at
least D_f/W_f f*A^-1 f + e*D e/W_e, and jk the coupling: m k^2 = s d^2. But m <= tau d, k^2 <= 4 theta^2 W_f d e*D e and s >= gamma e*D e. Finite gain adds to s and d alone. Q.E.D. Together with a second pole or
capacitance at inputs: not covered.

The nodes are what a board's stray capacitance finds first, and rho = 10 leaves it little. With op-amps as they are sold take `residual_gain = 1`, which the
errors of parts do not know of; siemens raise the capacitance as much as themselves. Measured, by the poles of the tables' array at alpha = 1e-3:

)";

inline constexpr const char* ladder_costs =
    R"(*What it costs.* |y| is 3 to 4 times |f|: so much less headroom. At small alpha the main rows' own decay, rho d W_f/D_f, is all that the roughest y have, so it settles like a crossbar and
not like least_squares. No margin is proven: parts that err move the metric in which V falls; draws are judged by their poles. At nodes without capacitance
the resistors' white noise has no size, so noise is said only with `parasitic = { node = ... }`.

*What it is for*: many taxels, parts of 1 % and alpha of 1e-3 or more, where the stabiliser's resistors are the error. Median and 95 of 100 builds, parts of 1 %:

)";

inline constexpr const char* ladder_numbers =
    R"(At alpha = 1e-5 K is the error, and a ladder changes nothing. `certify` draws it beside the others, of up to 260 amplifiers, and recommends it where it reaches what they do not. A better class for
the stabiliser alone, `tolerance = { relative = 0.01, stabiliser = 0.001 }`, does as much.

)";

}  // namespace tactile_net::circuits
