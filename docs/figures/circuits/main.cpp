// Writes docs/circuits.md, its numbers from this library and ngspice, and circuits/opamp_*.lib.
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "docs/figures/circuits/ladder_texts.hpp"
#include "docs/figures/circuits/numbers.hpp"
#include "docs/figures/circuits/opamp_texts.hpp"
#include "docs/figures/circuits/refinement_texts.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/network/opamp.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::circuits;

constexpr const char* introduction =
    R"(# The circuits

Eight ways to build a network whose node voltages solve `P f = b`, what is proven of each, and what ngspice finds.
Written by `tactile-net-circuits .` (target `tactile_net_circuits`); no number in a table is typed in. The array of every table:
21 taxels, pitch 0.5, strain_x at depth 1.5, a cylinder of half width 2, E = 1, nu = 0.45, l = 1, 1 mS and 1 V per unit.

The columns of the tables:

- *agreement*: ngspice's answer with ideal parts (op-amps as nullors) against the direct solve, relative in the 2-norm.
- *slowest pole*, *settles*: with op-amps of gain 1e6 and a gain-bandwidth product of 10 MHz (10 pF at the nodes where there are
  no op-amps); to 1e-3 of the end, from rest. First what the linear state space says, then ngspice's transient.
- *proven margin*: every error of resistors up to this leaves the network stable; whatever the bandwidths for `ideal` and for complementary
  outputs (of `lattice` as long as its op-amps share one), otherwise as long as converters and inverters are fast against the network.
  Nothing is proven for op-amps with second poles or capacitance at their inputs.
- *median error, 1 % parts*, *stable builds*: over 1000 draws of every resistor, dividers included, by linear algebra.

## Which one

At alpha = 1e-3:

)";

constexpr const char* choice =
    R"(
- To check that the network solves the problem use `ideal`.
- To build it use `lattice`: one amplifier a traction, no ringing with one pole, second poles from twice the bandwidth on
  with any capacitance at the op-amps' inputs (below that only without any), and parts of 1 % cost it least. It takes the readings themselves, so no resistors form P,
  which squares the condition number. It needs four resistors an entry of K.
- If alpha is small, and its slowest directions take too long, use `least_squares`: more amplifiers, less time. The second
  pole of its op-amps must lie far above their bandwidth (T6 says how far).
- With parts of 1 % and more taxels than the lattice bears use `least_squares` with a ladder, with the same op-amps.
- With alpha of 1e-3 or more `crossbar` with complementary outputs has the fewest parts, and needs no rule on bandwidths.
- Which amplifiers to buy: [below](#parts-that-are-sold).
- The thesis proposes `nic`, `lc` and `ndr`; `rail` does the same as `nic` with O(N) op-amps, and is the most sensitive of all.
- `tactile-net certify SCENE.toml` recommends one for the scene's alpha and tolerances.
- The same commands make circuits of small skins: [skins.md](skins.md#as-a-circuit).

## How stability is known

`.op` and `.ac` do not show it: a network that grows has an operating point, too. These do:

**The state space.** From the parts of the deck (sub-circuits' insides and the polarity of every input
included) the library assembles `C x' = -G x + b`, by modified nodal analysis, and from it `x' = A x + b`, which it decomposes: poles, the
growing mode, settling time. Capacitors may stand between any two nodes. The same G gives the rest point and what offsets and bias currents do.

**The reduced equations.** With fast converters and inverters every network is `T z' = -S z + h`: z the node voltages, or the amplifiers'
outputs; T > 0 diagonal, the nodes' capacitances or the rows' conductances over 2 pi bandwidth. If the symmetric part of S is
positive definite, `V = z' T z / 2` falls: `dV/dt = -z' S z < 0` about the fixed point. That is the *proven margin*: component errors
move S by at most E eps, and sym S stays positive definite while eps times the largest eigenvalue of D^-1/2 E D^-1/2 is below 1. D is
the least eigenvalue of the outputs' block of sym S, and for the residuals' block its diagonal times the least eigenvalue in those units;
the two are coupled by a skew block.

**Finite gain** A of the op-amps is in every theorem on stability below. Where one says *only if*, gain is infinite: finite gain adds positive parts to
the equations, so a P that is not definite by less than they are settles too, at an answer that is not that of P f = b. The certificate calls such a P not definite.

**ngspice's transient**, with three precautions: sources step from zero (an unstable circuit stays at its DC solution for a while),
trapezoidal integration (Gear's damps growth), first steps of 0.02/bandwidth. If the certificate says unstable the sources begin with a kick,
each by another share, because a symmetric load does not excite antisymmetric modes. An unstable circuit is reported with its growth and its mode beside the
certificate's.

**Yield** is counted on the reduced equations, op-amps fast against the network. Every build has the scene's op-amps at rest: offsets and bias currents
[as data sheets mean them](#offsets-and-the-answer-at-rest), finite gain, common-mode rejection and output resistance as they are. If the certificate's poles disagree, it says so.
A circuit is recommended only if it is known to be stable with everything that the scene states, by its poles or, beyond 1500 states, by its theorem.
Theorems and margins take complementary outputs for exact opposites; `tolerance = { relative = 0.01, balance = 0.001 }` draws their difference, and
`stabiliser = 0.001` gives the stabiliser's resistors, where differences cancel, their own tolerance.

**Noise**, where op-amps have a `noise_voltage` e: x' = A x + white noise of 2 k T g for every resistor and (W e)^2/2 for every op-amp (and i^2/2 at every input of a `noise_current` i) has the
covariance X of A X + X A' + Q = 0 at rest (Lyapunov). Of a crossbar whose rows have the same total D it is W (k T + D e^2/4) P^-1, in siemens:
the resistors' part is equipartition and holds for any D. More siemens lower it until the op-amps' own part is left; then only more volts help.

## From a scene to a board

Five commands lead from `scenes/circuits/board.toml` to parts, board, schematic and datasheet, to the files that a maker takes, then to ngspice with the board's copper, to a deck of the parts that are soldered, and, once it is built, to what is wrong with it:

<!-- not run: minutes of ngspice, and a board that is measured -->
```sh no-run
tactile-net certify scenes/circuits/board.toml --budget 0.3% --datasheet --out out
/usr/bin/python3 out/fabricate.py
tactile-net relax out/board.ordered.toml --board out/board.kicad_pcb
tactile-net gen out/board.ordered.toml --budget 0.3% --board out/board.kicad_pcb -o out/board.cir
tactile-net bench out/board.ordered.toml measured.csv --out bench
```

`out/board.ordered.toml` is the scene with the realisation and the siemens that its board asked for, comments kept: all that follows goes on from it, `certify out/board.ordered.toml --board routed.kicad_pcb` of the board that you have changed in KiCad too. It says so in its first line
if it names other files: move it beside the scene then. `--board` takes the place of `parasitic.node` and `parasitic.input`: every node of `relax`'s circuit and of `gen`'s deck (`Cbn0` and so on) has the capacitance of that file's copper. Without a built board
`bench out/board.ordered.toml --simulate measured.csv` writes an example of measured.csv. Of 41 taxels `certify` takes some two minutes of an idle core, its datasheet included, and `relax` some minutes, nearly all of them ngspice's transient. The scene names a part that is sold, OPA1637. As shipped, at 40 mS, the circuit has a phase margin of 39 degrees on its board;
at the 64 mS that `certify` raises it to it has 45, and settles in 2.54 us, in ngspice within 0.01 % of that. 174 of its 6966 resistors are of 0.1 %, the others of 1 %, and all of 400 builds that were drawn anew, resistors and op-amps, are within 0.3 % of the exact answer, 95 of 100 within 0.25 %. The same
scene of eleven taxels (`count = 11`, `half_width = 0.5`) has 46 degrees at 57 mS and settles in 1.74 us, in ngspice within 0.02 % of that; 95 of 100 builds are within 0.29 % (its contact is narrower, and presses harder: `volts = 1.6` keeps its outputs within 31 mA).

*Why this part.* Copper asks for slow amplifiers: OPA1637 has 4.6 MHz at each output; OPA1632, of 90 MHz, has 33 degrees of eleven taxels where its least resistor is 100 ohm, and less with a second pole. Slow ones leave their offsets: uniform within 200 uV they alone move 95 of 100 answers by up to 0.3 % at 1 V, and more volts
are not to be had, since the margin's 64 mS draw 33 mA from an output at 1 V, and it gives 31. So the scene has 2 V per unit, 0.64 V at the largest, and a controller that [subtracts the answer without a contact](#offsets-and-the-answer-at-rest). *What is assumed.* `circuits/parts` has no second pole, input capacitance or output
resistance of its data sheet: the scene states 18 MHz, which leaves 65 degrees at a gain of 1, and 2 pF. Without both it has 50 degrees at 40 mS; an output resistance of 30 or 100 ohm takes 2 or 3 degrees of eleven taxels' margin, and makes them settle in 2.8 or 5.3 us. Let the maker's
[macromodel](#a-vendors-macromodel) judge it before you order.

## What to order

`tactile-net certify SCENE.toml --budget 0.3% --out out` finds how exact each resistor must be so that 95 of 100 builds err by less. To first
order a resistor's relative error t moves the squared answer by v t^2/3, v from the inverse of the reduced equations. So with a
Lagrange multiplier on the mean square error each resistor's class is chosen by itself; the multiplier is found by halving, the rest is spent on coarser parts, and the dual
bounds the price of any list. 95 of 100 builds lie within 1.55 times the root mean square: measured, and checked by draws with the list
itself; if few parts count and the draws miss, a new list is made for a smaller target. What is said of the list in the end is of other draws, with which nothing was chosen, and with Wilson's interval. Every build has the scene's op-amps, as in the yield, their
`balance` too: the resistors get what these leave of the target, and if they leave nothing the output says how much each property of the op-amps takes. All realisations are compared, except
those not known to be stable with the scene's own op-amps. Typical prices: 0.002, 0.05, 0.12 and 1
for a resistor within 1, 0.1, 0.05 and 0.01 %, 2 for an op-amp; `parts` under [`network`](scene.md#network) states your own prices and classes. The better parts are where differences cancel: in the stabiliser at
alpha = 1e-3, in K at 1e-5.

*Loads*: a part's weight is the mean over five loads, the scene's contacts and the same moved along the sensor by an eighth and a quarter of its
length either way; a build's error is the root mean square over them. One load alone needs fewer better parts. Of 41 taxels at alpha = 1e-3, for 0.3 %, parts of exactly the values wanted
(a third place each an eighth of the length to either side; 200 draws; the last column: each load's own draws, the worst of them):

)";

constexpr const char* values_text =
    R"(The ladder needs the fewest better parts: less than 70 for all five places, 22 for one, where `lattice` needs 75 to 169 of twice as many resistors. `lattice` is still cheaper,
since an op-amp costs as much as forty better resistors and it has half as many: `certify --budget` names both. If each load by itself must meet the target, ask for a tenth less: over five places
the worst load's draws lie up to 12 % above the mean's.

*Values* are of the scene's series, E96 where it names none. One part is within 1.5 % of any value, two in series or in parallel, of 1 ohm to 10 megohm, within 3e-4 (2e-4 from 100 ohm to 100 kilo-ohm). An entry of
K' becomes what that of K became, times their ratio: an error that both share only changes the model. Parts of better classes are pairs, and as
many of the others, those that count most first, until values take a sixteenth of the squared error; the rest is left to tolerances.

The folder has these files of the cheapest circuit that may be ordered. `parts.csv` is the list to order: value, tolerance, quantity, designators of resistors, and the op-amps. `BOM.csv`
is for assemblers, a part a row: `Comment` (its value such as `4.99k` or `499R`), `Designator`, `Footprint`, `MPN` (of the op-amps, where the scene names a part; the resistors' is for you to fill in), tolerance, its name in the deck, the other
one of a resistor's pair, and a note if the scene's contacts put more power into it than its size carries (0402 62.5 mW, 0603 0.1 W). `board.kicad_pcb` opens in KiCad 6 and newer, with designators, values, tolerances, courtyards and nets; resistors
are 0402 and, of better classes, 0603. An op-amp is in its part's own package, SO-8, VSSOP-8 or VQFN-16 with the pad below it, with the part's own pins (the table below); where the scene names no part, an SO-8 with the usual ones. Of a
fully differential amplifier VOCM is at ground, which is the middle of VCC and VEE, and power-down, active low, at VCC; of two op-amps in a package one is used, and the other is a follower at ground. Beside each op-amp stand 100 nF from VCC and from
VEE to ground, beside the supply 10 uF each. Readings come in by pin headers of two rows along the upper edge, 2.54 mm, for ribbon cables: at most 20 a header, each with a pin of GND beside it, the odd pins the readings, pin 1 square; outputs leave by the same along the lower edge,
the even pins the outputs. Beside them three pins have GND, VCC and VEE. Silk names the net of every pin; each residual and each op-amp's output has a test point.

The board is routed, on four layers: a net that many resistors have is a track along their row on `F.Cu`, whose name stands left of it; those that share another net stand in one column, which a track on `B.Cu` joins, its name above; GND is a plane
on `In1.Cu`, VCC on `In2.Cu`. VEE is a bus of 3 mm between a row of op-amps and their capacitors, and from there a track of 1.2 mm to its pin; `certify` says how far it falls on them to the farthest op-amp, each of which takes what its data sheet says: of 10 mA each less than 10 mV, of 11 taxels (but `nic`, whose 54 op-amps make it 31 mV) and of `lattice` of 41. Rows and columns are by construction as far apart as their tracks need, so every net of every realisation is joined at any size: what grows is the board (`lattice` of 11 taxels 101 by 182 mm, of 41
taxels 321 by 392 mm, more than most makers take). `board.kicad_pro` has the design rules that are kept, those of most makers of such boards: tracks 0.15 mm, clearance 0.127 mm, vias 0.45 on 0.2 mm. KiCad 6's own check finds no violation
and nothing unconnected once its planes are filled. `gen SCENE.ordered.toml --budget 0.3%`
writes the deck of the same parts, with each tolerance as a comment.

`fabricate.py` makes of the board what a maker takes: run by the Python that KiCad 6 or newer belongs to (of Debian and Ubuntu `/usr/bin/python3`) it fills the planes, runs KiCad's check, and writes `fabrication/`, with a Gerber file of each layer, the holes as Excellon files, and all of
them as `board-gerbers.zip`. If a rule is broken or a net is not joined it says where, and writes nothing. It takes a board that you have changed too: `fabricate.py routed.kicad_pcb`. `board.pos.csv` says where a machine places each part: designator, value, package, middle (mm, from the same corner
as the Gerbers, y up), rotation (degrees against the clock, as KiCad counts it: compare the assembler's preview, some count others for a package) and layer. Headers are soldered by hand: they are in `BOM.csv` and `parts.csv`, and not there.

`board.kicad_sch` is the schematic of that board, for KiCad 6 and newer: headers, the supply, and a sheet for each row of the arrays, `board-row0.kicad_sch` and so on, with the row's resistors array by array, its amplifier with its capacitors, and its test points. Nets are global labels. Symbols are in the files, and
carry designator, value, tolerance, footprint, the amplifier's order number (MPN) and, hidden, the name in the deck. Its netlist is the board's: tests compare both, pin by pin, with a reader of their own. KiCad's check of electrical rules has nothing to report: pins have types, open ones are marked, GND, VCC and VEE have a PWR_FLAG (tests, by those rules). That symbols and footprints stand in no library of yours, or differ from KiCad's,
`board.kicad_pro` lets pass. In KiCad open `board.kicad_pro`; *Update PCB from Schematic* relinks footprints by their designators.

## On its board

Copper loads every node, and enough of it makes any of these circuits oscillate. `certify --budget` therefore certifies the board that it writes, and `certify SCENE.toml --board board.kicad_pcb` one that you have changed in KiCad (6 or newer):

- A *pad* has eps A / h to the nearest plane (a layer of which a zone of GND, VCC or VEE covers half of the board) and at each edge what a track as wide as the pad has there. A *track* is a microstrip by the formulas of Hammerstad and Jensen (1980), with
  its width, the copper's thickness and height and permittivity of the file's stackup; a *hole* has 55.5 pF/m eps T D1 / (D2 - D1) (Johnson and Graham 1993). All of it counts to ground, neighbouring tracks too. Where pads of a net are not joined, as on a board from which tracks were taken, the missing tracks are the shortest tree
  along x and y, 0.15 mm wide: routers need some more. Without a plane the board's other side is taken for one, and said.
- The node between two resistors in series is none of the circuit's own: each end takes its share of the capacitance, exact to first order in frequency but for what couples the ends.
- Poles, noise and settling are then computed with each node's own capacitance, which takes the place of `parasitic.node` and `parasitic.input`. The *phase margin* is the least angle by which all amplifiers' inputs, turned alike at one frequency, make the circuit oscillate: of the loops'
  characteristic loci (MacFarlane and Postlethwaite 1977) the one that passes nearest to -1. Of one amplifier it is the usual phase margin. It is computed up to 600 states; beyond, poles alone decide.
- Below 45 degrees (`--phase-margin` states others) the siemens are raised, as smaller resistors wait less for the same capacitance, and the parts and the board are made for them; no resistor may be below 100 ohm. More siemens draw more current: if an output would then carry more than its part gives, `certify` says which volts would do. Isolation resistors at the outputs are not added: every output's copper lies inside
  its loop, where a resistor adds lag. Of a board from a file the output says which siemens would do on the same copper.
- `board.kicad_pcb` is not written if the circuit oscillates on it, unless `--oscillating-board` asks for it. `copper.csv` has every net's pads, tracks and capacitance.

A board of another circuit is refused with the part, the net or the value that differs. No theorem but the crossbar's T5 speaks of capacitances that differ from node to node: poles decide.

## A datasheet

`tactile-net certify SCENE.toml --datasheet`, with `--budget` of the parts to order, says of builds what a data sheet does: error at rest, offset, settling time, noise and supply current, each with its least (min), its median (typ) and
what 95 of 100 of all builds are within (max), over tolerances, op-amps and temperature, from draws with which nothing was chosen. The two ends between which 95 of 100 lie are ranks of the draws (Clopper and Pearson), so they hold for any distribution.
`limits = { error = 0.003, settling = 3e-6 }` under [`network`](scene.md#network) says what is wanted: *pass* if 95 of 100 are within it as surely as that, *FAIL* if they are not (the command then exits with 1), else these draws do not decide.
With `--out` the folder has `SCENE.datasheet.json`. With `--budget`, or `--board`, the builds have the siemens and the capacitances of that board.

Error and offset are of 200 to 1000 builds of the reduced equations; settling and noise of 75 to 200 builds with all their poles, each op-amp with an offset, bias currents and, with `bandwidth = 0.2` in `tolerance`, a bandwidth of its own.
The supply current is each op-amp's own, typical of its data sheet, and what its outputs give off at rest; that op-amps differ in their own, and take more warm, is not in it. ngspice has the same error, settling time and noise of each build, and over 1,000 builds of its own, of eleven taxels, median and 95th percentile of error, offset and
settling time within 2.5 % of the datasheet's, over 24 builds noise within 3 %; of each build the current that its outputs give off within 0.1 %.

## Offsets, and the answer at rest

A data sheet says two things of an offset or a bias current. What lies about 0 has its *typical* value for its standard deviation, as makers say ([Texas Instruments](https://ti.com/document-viewer/TLV9104-Q1/datasheet/GUID-3B4FC411-7D54-4644-BBFA-3211BAA9A89F)); beyond its *maximum* no part is sold. Builds are drawn so: normal where only the
typical value is known (`offset`, `bias_current`), that normal cut off at the maximum where both are (`offset_limit`, `bias_limit`), uniform within the maximum where that alone is, which says nothing of what lies inside. `offset_drift` (V/K, uniform within it) counts with the `temperature` of
[`tolerance`](scene.md#network). A figure that a scene states beside a part takes the place of the part's.

An offset moves every answer alike, whatever is read: a controller that measures the answer once without a contact, and subtracts it from then on, is rid of it. `tolerance = { relative = 0.01, tare = true }` says that yours does: yields, lists of parts and a datasheet's error are then of answers less those without readings. Offsets and bias currents are the
same in both, whatever the resistors of the build, so they cancel exactly, in ngspice too; what offsets drift by since, resistors, finite gain, common-mode rejection and balance stay. A datasheet's offset is told as it is ordered: that is what the controller subtracts, and what of the converter's range it takes.

## Parts that are sold

`opamp = "THS4551"` takes the figures of a data sheet, from `circuits/parts/THS4551.toml`, which says of each where the data sheet has it. `opamp = { part = "THS4551", second_pole = 270e6, supply = 5 }` states
others beside it: `certify` warns of second pole, input capacitance and output resistance where neither the table nor the scene has them, since a verdict without them says nothing of what they do.
`supply` (V in all) keeps the outputs within it.

A distributor's *fully differential amplifier* (FDA) is what `crossbar`, `least_squares` and `lattice` take, an *operational amplifier* what `nic`, `rail` and `inverters = true` take; the wrong kind is refused. An FDA's data sheet states
gain, gain-bandwidth product and slew of the difference of its outputs: each output has half of them, and so has the deck. A stated `bandwidth` or `slew` is of one output. Where a data sheet gives a phase margin at a gain of 1
the second pole is the one that makes it.

Each file's `[pins]` says what each pin of the package is for, and `price` what one costs by a class, of a hundred at distributors: compare both with the data sheet and the offer before you order. Two amplifiers in a package are told by two numbers; `0.006 to 0.5` is a typical value and a maximum, `to 0.2` a maximum alone:

)";

constexpr const char* after_parts =
    R"(## Voltages as inputs

`inputs = "voltage"` takes each reading as a voltage behind a resistor of the circuit's own, where op-amps drive the nodes (`crossbar`, `least_squares`, `lattice`): sensors' amplifiers give voltages, and ideal currents
are matched pairs of sources each. An answer of currents is as far off as all resistors together are: a reel 0.4 % high costs 0.4 %. With voltages every node is a ratio of resistors, and what all of them have in common
cancels, exactly and with any gain of the op-amps; an `output_resistance` alone does not scale with them. In `nic`, `rail` and `ideal` the nodes carry the answer and would be loaded: they are refused.

The resistor of a reading takes as much current as the largest row of K (of P in the crossbar) does: so no reading's voltage is above the largest that the answer can have with it, and all are in one unit, which `certify` says.
They are part of each row's total conductance: of D_e and of the lag's bound (T6, T6L), of D and C/D (T5), of D_u (T7), in which the rows of `lattice` are weighed so that every residual counts as before. No theorem asks for less
conductance, so all hold. What it costs is noise and offset, since the op-amps' own are amplified by the larger totals. Capacitance across an input's resistor passes a step at once: it is in the state space. `crossbar` takes the voltages of
b = K'g, a digital product, as it takes its currents.

## What resistors have in common

Beside what each resistor is off, in [`tolerance`](scene.md#network): `reel`, an error that all of a build share, uniform within it; `measured = { file = "reel.csv", nominal = 10e3 }`, parts of a reel that were measured: every resistor has their mean (as well as
so many parts tell it) and their spread, in place of `relative`; `temperature = { kelvin = 40, ppm = 50, tracking_ppm = 5 }`, builds that work up to 40 K from where parts have their value, with 50 ppm/K that all of a build
share and 5 ppm/K of each part beside. All are in the yield, in the draws of `--budget` (the measured reel is that of the coarsest class there) and in the datasheet. Parts of different values are of different reels: what those do not
share is each part's own.

## A vendor's macromodel

`tactile-net relax SCENE.toml --model VENDOR.lib` runs the circuit with a vendor's macromodel in PSpice's language in place of our op-amps (ngspice's `ngbehavior=psa`), each with a supply of its own, in the
[same confinement](strangers.md#macromodels-relax---model). It compares what the certificate says with what ngspice sees: `as_certified` is stable or not as certified, and settles within a fifth of the certified time; `settles_otherwise`, `does_not_settle` and
`settles_uncertified` say what differs, `answers_otherwise` that at rest it is more than a tenth off, so that its pins may be taken wrongly. A macromodel that is as the scene's op-amp settles within 5 % of the certificate.

The sub-circuit is the one of the part's name, or that no other calls. Its pins are expected in the usual order: `in_plus in_minus supply_plus supply_minus out`, and of two outputs `in_plus in_minus supply_plus supply_minus out_plus out_minus common_mode`; one
more is for power-down. Another order is the scene's, under `[network]`: `model = { name = "THS4551", pins = ["in_plus", "in_minus", "out_plus", "out_minus", "common_mode", "supply_plus", "supply_minus", "power_down"], supply = 5 }`. The signals lie
about 0 V between the supplies, power-down and common mode are tied as on the board.

## On the bench

`tactile-net bench SCENE.toml MEASURED.csv` finds what is wrong with a board that is built. MEASURED.csv has a pattern a row: a current of each input, `I0`, `I1`, ... (A; of `lattice`, into the node v of a reading's pair and out of u), then the voltage
of each output, `n0`, `n1`, ... (V; empty where it is not known, as at a converter's end). A row whose currents are 0 is the rest, and is subtracted: op-amps' offsets do not count. Each input by itself is enough, and
`bench SCENE.toml --simulate board.csv --fault open:Rk3_3p` writes an example: parts within the scene's tolerances, the scene's op-amps, a converter of 12 bits. Parts are told by their names in the deck: column
`Element` of the board's `BOM.csv` has them beside their designators, two of a resistor that is a pair.

*How*. A resistor adds g l w' to the equations S of the circuit, so another value of it changes the responses by c (C S^-1 l)(w'S^-1 H) exactly, c = -dg/(1 + dg w'S^-1 l), and two that are swapped by Woodbury's formula of rank two. Responses of healthy boards have the covariance
J T J' + s^2 I, J the sensitivities, T the tolerances' variances (uniform), s the converter's noise. Each part is tried open, bridged, with ten times and a tenth of its resistance, with another value (whose likelihood is integrated over), and swapped with every
other; the best are tried again with the sensitivities of the faulty board. A fault is named if its likelihood over that of none exceeds 20 times the number of faults tried: so at most 5 of 100 healthy boards are accused (a likelihood ratio exceeds x by chance with a probability of
at most 1/x). What explains the responses as well within a factor of 20 is *not told apart*: the two resistors of a lattice's pair always are, since their difference is common to both inputs. `not_explained`: no single fault is enough.

Of 100 boards of `lattice` with eight taxels, parts of 1 %, 12 bits and a fault that its responses show (open, wrong decade, swapped), at least 95 have it named among four candidates at most; of 100 healthy ones at most 5 are accused: tests hold both. Faults of parts that
hardly matter stay unseen, and do no harm.

*The correction* is a matrix: exact voltages are the correction times the board's. It comes from the fitted board, the named fault and the most likely errors of all parts beside it, and is the smallest that noise allows; what remains, and by how much it enlarges noise, is told.
A healthy board of 1 % errs by some 1 %, and by less than 0.1 % behind it. `--out out` writes `correction.csv`.

*The self-test* needs no bench. After an answer f a controller computes r = b - P f in numbers, sends it into the summing nodes, where the same network answers d, and w = r'd / d'P d: |w d|/|f| is the board's own error, up to some per cent of itself. `bench` says
the limit to accept, which 95 of 100 builds of the scene's tolerances keep.

## Other simulators

`gen --dialect ltspice` or `xyce` keeps the documented rules of these simulators: no `^`, which LTspice takes for an exclusive
or; `noopac` for ngspice only, elsewhere 1 milliohm in series with each inductor of `lc` and 1 teraohm from each output to ground; for Xyce `.print`, currents
of devices and of slewing op-amps in braces, packages of options, and `PARAMS:` before a sub-circuit's. Negative resistors are marked as untried. Neither simulator was at hand:
ngspice reads the decks for LTspice to the same answer, and gnucap those of every realisation of resistors and op-amps, of the ladder too.

`gen --subcircuit NAME -o x.lib --symbol x.asy` writes the circuit without its sources: its pins are the nodes of the readings' currents or voltages
(of `lattice` a pair for each reading), then the outputs, in a circuit of your own; the symbol is LTspice's.

## ideal

![The network of conductances](circuits/ideal.svg)

A resistor `1/(-P_ij)` between nodes i and j, negative where P_ij > 0; one of the row sum to ground; a current b_i. Kirchhoff's
law at node i is row i of P f = b.

**T0.** With capacitance C at its nodes, `C v' = -P v + b`: settles if and only if P is positive definite. *Proof:* C^1/2 v turns
it into a symmetric system with C^-1/2 P C^-1/2, of P's inertia (Sylvester).

)";

constexpr const char* nic_text =
    R"(## nic

![A floating and a grounded negative impedance converter](circuits/nic.svg)

One converter of two op-amps for every negative branch, one op-amp for every negative row sum. The '+' inputs belong at the network's
nodes: with inputs swapped the operating point is the same, and every converter grows at the op-amps' full bandwidth.

**T1.** Stable for any node capacitance, any bandwidths and any second poles if and only if P is positive definite; with one pole
no mode rings. *Proof:* let o be the converters' outputs. A floating one has '-' inputs at (2 o_a + o_b)/3 and (o_a + 2 o_b)/3, a grounded
one at o/2, so with y = (v, o) and each op-amp's equation times its G

    diag(C, G/W) y' = -S y + (b, 0),   S = [M, -B; -B', G T],   T = [2 1; 1 2]/3 or 1/2.

S is symmetric, G T is positive definite, and the Schur complement M - B (G T)^-1 B' is P, since T^-1 = [2 -1; -1 2] or 2. So S > 0
if and only if P > 0, and diag(C, G/W) >= 0 does the rest. Finite gain adds G/A to S's diagonal. Second poles make
`M2 y'' + M1 y' + S y` of it with M2, M1 >= 0: an eigenvector y gives a quadratic with real coefficients that are not negative. Q.E.D.

**With capacitance c at the inverting inputs.** With one pole, and one W within each converter: stable if and only if P is
positive definite as long as the dividers' resistors keep r <= 1/(W c (1 + (1 + 1/A)^1/2)), A the gain: 1/(2 W c) where it is large.
*Proof:* let tau = r c and split a floating pair into its common (k = 1) and differential (k = 3) voltage; a grounded converter has k = 2. In each,
the '-' input sits at m = o/(k + tau s) and o (s/W + 1/A) = v - m, so the converter's admittance over G is
Y(s) = 1 - (k + tau s)/(D + a s + d s^2), D = 1 + k/A, a = k/W + tau/A, d = tau/W, and Y(0) = 1 - k/D. On s = jw Re Y >= Y(0) is
0 <= (k a^2 - D k d - D tau a) w^2 + k d^2 w^4, which holds for x^2/A <= k^3 - 2 k x, x = tau W: of k = 1, 2, 3 the first asks most, x^2/A + 2 x <= 1.
The denominator has its roots in the left half plane, so Y - Y(0) is positive real: in C s + P' + sum G (Y - Y(0)) b b' no voltage v with Re s >= 0 has
Re v*(...)v below v*P'v > 0, P' = P and what finite gain adds to it, k - k/D > 0 a converter. Q.E.D. Capacitance together with a second pole is not covered.

)";

constexpr const char* rail_text =
    R"(## rail

![An inverter and a grounded converter at each node](circuits/rail.svg)

An inverter per node offers -v_j: a positive P_ij is a resistor from n_i to r_j and one from n_j to r_i. What that leaves
to ground, the inverter's input taken off, is negative for most nodes: one grounded converter each. Two op-amps a node, and
errors of large conductances that almost cancel.

**T2.** Op-amps of equal bandwidth and gain: stable for any node capacitance if and only if P is positive definite. *Proof:* inverter and converter
answer as q = 1/(1 + 2 s/W). The nodes' law is C s v + K v + q E v = b with K + E = P; K, what is tied to nodes and ground directly, is
diagonally dominant, hence positive definite. Times 1/q: (2C/W) s^2 + (C + 2K/W) s + P = 0, three symmetric matrices of which the first
two are not negative. Finite gain makes it q = 1/(1 + 2/A + 2 s/W), and adds 2C/A to the second matrix and 2K/A to the third.
Unequal bandwidths are not covered: an example at x/÷10 was unstable.

)";

constexpr const char* crossbar_text =
    R"(## crossbar

![The crossbar with complementary outputs](circuits/crossbar.svg)

Amplifier i holds its summing node at 0 V, where the row's currents P_ij f_j meet -b_i. Complementary outputs offer f_j with either sign.

**T5.** Stable if and only if P is positive definite, whatever the bandwidths W_i and the capacitances C_i at the summing nodes.
*Proof:* D s = P v - b with D the rows' total conductance, and v' = -W s: (C/W) v'' + (D/W) v' + P v = b. All three are symmetric, the
first two positive: a real quadratic with positive coefficients for every eigenvector. Finite gain adds C/A to the second and D/A to the third.

*Second poles* W2_i: without capacitance the same with 1/(W W2) in place of C/W, for any of them. With both, as long as the least W2 is
not below the largest W: an eigenvector gives a cubic with m3 of C/(W W2), m2 of C/W + D/(W W2), m1 of D/W and m0 of P. Its first part makes
m2 >= min W2 m3; and min W2 m1 >= the form of D >= that of P, since the rows of |P| sum to D. So m2 m1 > m3 m0: Routh. Finite gain adds
C/(A W2) to m2, C/A + D/(A W2) to m1 and D/A to m0; m3 D/A is one of the terms of the new m2 m1. Q.E.D.

)";

constexpr const char* crossbar_inverters_text =
    R"(### With inverters

![The crossbar with inverters](circuits/crossbar-inverters.svg)

Single-ended op-amps and an inverter per node (`inverters = true`).

**T3.** Main op-amps of at most half the inverters' bandwidth (k W, k <= 1/2, the default) and of no more gain: stable if P is positive definite, for
any capacitance at the main summing nodes. *Proof:* let P = P+ - N with P+ and N what comes from the amplifiers and from the inverters, no entry of either negative.
With g = 1/A of the main op-amps and h of the inverters a main row has -(p/(k W) + g) f at its summing node, and an inverter answers as
q = 1/(a + 2p/W), a = 1 + 2h. So for an eigenvector, with c, d, p+, n the forms of C, D, P+, N and s = p/W:

    (W c s + d)(s/k + g)(a + 2s) + p+ (a + 2s) - n = 0.

Rows of P+ + N sum to D: p+ + n >= -d and n >= -d. As p+ - n > 0, p+ > -d/2. The cubic's coefficients are m3 = 2Wc/k, m2 = aWc/k + 2d/k + 2Wcg,
m1 = a (d/k + Wcg) + 2dg + 2p+ >= 2d - d, and m0 = a d g + a p+ - n = (p+ - n) + 2h p+ + a g d, which exceeds (p+ - n) + (a g - h) d: positive, since g >= h.
And m2 m1 - m3 m0 = (Wc/k)(a m1 - 2 m0) + 2 (d/k + Wcg) m1, where a m1 - 2 m0 = a^2 (d/k + Wcg) + 2n >= 2d - 2d: Routh. Q.E.D.
Main op-amps of more gain than the inverters are not covered: at infinite gain, with inverters of A = 10, an example is unstable at rest already (m0 < 0).

)";

constexpr const char* least_squares_text =
    R"(## least_squares

![Two crossbars around K and its transpose](circuits/least_squares.svg)

Residual amplifiers hold e = -rho (K f - g), main amplifiers K'e = rho R f with R = alpha (l^2/D^2 Q + I): the fixed point is
(K'K + R) f = K'g. The currents are the readings; b is never computed. Conductances are K over its largest column norm, so the answer
does not depend on K's unit.

**T6.** With complementary outputs: stable for every rho and every bandwidth. *Proof:*
(D_f/W_f) f' = K'e - rho R f and (D_e/W_e) e' = -(K f - g) - e/rho. About the fixed point V = (f' D_f/W_f f + e' D_e/W_e e)/2 falls:
dV/dt = -rho f'R f - |e|^2/rho < 0, because the coupling cancels: e'K f comes with either sign. Finite gain subtracts (f'D_f f + e'D_e e)/A besides.

rho buys speed at small alpha: the slowest pole grows with it, until the residual amplifiers themselves are the slowest.

**With capacitance at the summing nodes and second poles.** Let tau be the largest C/D + 1/W2 of a row (D its total conductance), W the
largest bandwidth, W_f the main amplifiers' largest, gamma the least feedback conductance of a residual row over its D_e, and
theta = |D_e^-1/2 K D_f^-1/2|_2, at most 1. Stable if

    4 theta^2 W_f tau < gamma (1 - (1 + 1/A) W tau/4)^2.

*Proof,* first of infinite gain: with z = (f, e) and X = D/W the rows are X p (1 + tau1 p)(1 + tau2 p) z + (S + J) z = h, S = diag(rho R, g_e) > 0, J skew. Let all
lags grow from 0. New poles come in from -1/tau and S + J is regular, so a pole could only cross at p = jw. There, with m = sum X tau |z|^2,
d = sum X |z|^2, s = z*S z and jk = z*J z: w^2 m = s and |k| = w (d - w^2 m3), where m3 <= tau m/4. Rows of rho |R| and g_e are within D, so
w^2 m3 <= tau s/4 <= (W tau/4) d, and a crossing needs m k^2 >= s d^2 (1 - W tau/4)^2. But m <= tau d,
k^2 <= 4 theta^2 (f*D_f f)(e*D_e e) <= 4 theta^2 W_f d (e*D_e e), and s >= gamma e*D_e e: m k^2 <= (4 theta^2 W_f tau/gamma) s d^2.
Finite gain puts p + W/A in the place of the first p. With D = W X and u = W tau/4 it adds z*D z/A to s and sum D tau1 tau2 |z|^2/A to m, and |k| is at least
w (d - w^2 m3). So w^2 m3 <= tau s/4 <= (1 + 1/A) u d, m <= (1 + u/A) tau d and s >= (gamma + 1/A) e*D_e e; as gamma <= 1 and u < 1,
(gamma + 1/A)/(1 + u/A) >= gamma, and the end is the same. Q.E.D.

The loop's crossover has to lie below 1/tau, and rho = 10 puts it high: with a second pole at twice the bandwidth, as op-amps have it,
the array of the tables is unstable (certify says so). Measured limits lie two to six times above what is proven. `certify` prints the
number and the scale or `bandwidth_ratio` that brings it to 1; capacitance gives way to a larger scale, second poles do not.

)";

constexpr const char* least_squares_inverters_text =
    R"(### With inverters

**T4.** Stable if the main op-amps are slow enough. How slow is not proven: k = 0.2/rho, the default, is a rule of thumb, and not enough for some arrays with
deep sensors at alpha = 1e-7. So the certificate never says that it holds; with a bandwidth the poles do. It also gives away what rho would gain.

)";

constexpr const char* lattice_text =
    R"(## lattice

![Two arrays with passive nodes between them](circuits/lattice.svg)

A reading's residual is a pair of nodes u+, u- that nothing drives. Array A (conductances a_i |k_ij|, k = K over its largest column norm)
leads to them from the columns +f_j and -f_j, array B (b_i |k_ij|) leads on to both inputs of the amplifiers, which is where the
stabiliser's conductances meet them; signs are made by crossing the pairs. Readings are currents -+a_i g_i. With a_i = 4 b_i and b_i in proportion to
sum_j |k_ij|, every residual u = (A f - a g)/D_u has the same weight w = a_i b_i/D_u, and the currents vanish where (K'K + R) f = K'g.
A reading that comes as a voltage through a resistor adds that to D_u (`inputs = "voltage"`).

**T7.** Amplifiers of one bandwidth W: stable for any capacitance C at their inputs with one pole or with second poles W2 >= 2 W, for any second pole
without C, or for any capacitances C_u at the residuals' nodes with one pole and without C. Without any of them no mode rings. *Proof:* an amplifier has
f (p/W)(1 + p/W2) between its inputs, half of it at each, so that with H(p) = B'(D_u + p C_u)^-1 B, c = a_i/b_i and D_s the conductances at the inputs

    [ (p/2W)(1 + p/W2)(D_s + p C - H(p)) + c H(p) + w R ] f = 0.

A capacitance between an amplifier's two inputs counts twice in C. D_s - H(0) > 0, because D_s is the row sum of B' and |w R| while rows of H sum to at most 1/(1 + c) of B's. So without C_u the
three forms are symmetric and positive: every p is in the left half plane, and real where 1/W2 = 0.

With C an eigenvector makes of the forms D_s - H, C and c H + w R the numbers d, g and k, and a cubic of coefficients m3 = g/(2 W W2),
m2 = g/(2W) + d/(2 W W2), m1 = d/(2W), m0 = k. The same bound on H's rows gives d >= c/(1 + c) (B's row sums) + w (|R|'s) >= k, so m2 > W2 m3 and, where
W2 >= 2 W, W2 m1 >= m0: m2 m1 > m3 m0, which is Routh's condition. Finite gain A adds g/(2 A W2) to m2, g/(2A) + d/(2 A W2) to m1 and d/(2A) to m0;
m3 d/(2A) is one of the terms of the new m2 m1. The factor 2 is sharp: one reading of one traction has d = k, and with W2 < 2 W is unstable from
C = d/(2 W - W2) on.

With C_u an eigenvector gives h(p) = sum |k_i|^2/(D_u + p C_u) and F = (p/2W)(d - h) + c h + r. F(jw) = 0 asks for |Im h|^2 = (Re h + r/c)(d - Re h). But each term of h lies on the
circle through 0 and its value at p = 0, so |Im h|^2 <= Re h (h(0) - Re h), which is less, as h(0) < d and r > 0: no pole crosses, and C_u = 0 is
stable. Finite gain asks for more still: (c - 1/(2A)) |Im h|^2 = (c Re h + r)(d - Re h) + (d - Re h)^2/(2A). Q.E.D.

Resistors' errors do not harm the proof's symmetry: one resistor carries both directions' currents. So the *proven margin* needs sym S alone
(rows of residuals over c), whatever the errors, for one bandwidth, one pole and no capacitance; it covers the voltage that an amplifier's two inputs have
in common too.

Not covered: capacitance at the amplifiers' inputs and at the residuals, as every board has, nor across resistors or at outputs behind a resistance. Measured with the same C at both: stable while W C/D stays below
1.9 (one pole), 0.9 (second pole at twice the bandwidth), 0.46 (at the bandwidth), D the least conductance at an input or a residual.
`certify` warns beyond, with the scale that helps, and its poles decide. Unequal bandwidths are not proven either.

)";

constexpr const char* lc_text =
    R"(## lc

![Capacitors and inductors](circuits/lc.svg)

At one frequency w a capacitor g/w is a conductance jg and an inductor 1/(w|g|) one of -j|g|: with currents of 90 degrees the node voltages are
real, and are f. Passive, so never unstable; lossless, so it never settles either. In ngspice it needs `.options noopac`: at direct
current it has no operating point. An inductor's Q of 100 already costs some per cent; read the in-phase part.

)";

constexpr const char* ndr_text =
    R"(## ndr

![Devices of negative differential resistance](circuits/ndr.svg)

Every negative conductance is a device with an N-shaped curve of slope -g at 0 V: a cubic, or a tunnel diode biased at its steepest point. There
the curve has no quadratic term, and no slope below -g anywhere.

**Convexity.** The network's potential, the sum of the integrals of each branch's current over its voltage, has a second derivative of at least
P everywhere: strictly convex if P > 0. One operating point, approached from everywhere with capacitance at the nodes.

Beyond the device's own volts there is no such answer: if the curves may change it by more than half of itself, `gen` and `relax` refuse, and `certify`,
which judges the linear circuit, warns.

The error grows as the square of node voltages over the device's own (`device_volts`):

)";

constexpr const char* ending =
    R"(## The sub-circuits

`circuits/*.lib`, each with its pin order in its first lines; `floating_nic`, `grounded_nic` and `inverter` need a sub-circuit
`opamp`, which any one of `opamp_*.lib` provides; `crossbar`, `least_squares` and `lattice` use `amplifier`, of `amplifier_*.lib`. In KiCad: give the
symbol the field Sim.Library (the file) and Sim.Name, and include the op-amp's file on the sheet. A deck of `tactile-net gen` carries
all it needs.

| file | holds |
|---|---|
| `*_nullor.lib` | the ideal amplifier, for operating points |
| `*_gain.lib` | gain 1e6 |
| `*_one_pole.lib` | gain 1e6, gain-bandwidth product 10 MHz |
| `*_two_poles.lib` | a second pole at 20 MHz |
| `*_clamped.lib` | one pole, output within 12 V: diodes at the core, which converge where a tanh fails, and do not wind up |
)";

void write_amplifiers(const std::filesystem::path& folder) {
  const std::pair<const char*, OpAmp> models[] = {
      {"nullor", {}},
      {"gain", {.gain = 1e6}},
      {"one_pole", {.gain = 1e6, .bandwidth = 10e6}},
      {"two_poles", {.gain = 1e6, .bandwidth = 10e6, .second_pole = 20e6}},
      {"clamped", {.gain = 1e6, .bandwidth = 10e6, .rail = 12.0}}};
  for (const auto& [step, opamp] : models) {
    frames::write_file(folder / ("opamp_" + std::string(step) + ".lib"),
                       subcircuit_text({"opamp", opamp, Outputs::single}));
    frames::write_file(folder / ("amplifier_" + std::string(step) + ".lib"),
                       subcircuit_text({"amplifier", opamp, Outputs::complementary}));
  }
}

std::string page() {
  return introduction + comparison(1e-3) + "At alpha = 1e-5:\n\n" + comparison(1e-5) + choice +
         allocations_table() + values_text + parts_table() + "\n" + after_parts +
         table(Realization::ideal) + nic_text + table(Realization::nic) + rail_text +
         table(Realization::rail) + crossbar_text + table(Realization::crossbar) +
         crossbar_inverters_text + table(Realization::crossbar, {.inverters = true}) +
         least_squares_text + table(Realization::least_squares) + ladder_text + ladder_lags() +
         ladder_costs + ladder_tolerances() + ladder_numbers +
         table(Realization::least_squares, {.ladder = true}) + least_squares_inverters_text +
         table(Realization::least_squares, {.inverters = true}) + lattice_text +
         table(Realization::lattice) + lc_text + table(Realization::lc) + ndr_text + devices() +
         table(Realization::ndr) + opamps_text + opamp_classes_table() + motion_text +
         motion_table() + arrays_text + arrays_table() + refinement_text + refinement_table() +
         refinement_numbers + ending;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: tactile-net-circuits FOLDER   (with docs/ and circuits/ in it)\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    write_amplifiers(folder / "circuits");
    frames::write_file(folder / "docs" / "circuits.md", page());
  } catch (const std::exception& error) {
    std::cerr << "tactile-net-circuits: error: " << error.what() << '\n';
    return 1;
  }
}
