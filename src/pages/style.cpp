#include "pages/style.hpp"

namespace tactile_net::pages {

// Blue is normal and orange tangential wherever a picture has both. gnuplot draws on white: in the
// dark its plots are turned to light lines on black, hues kept. Rows of a table become cards where
// a window is too narrow for columns: none is lost.
std::string_view style_sheet() noexcept {
  return R"(
:root { color-scheme: light dark; --ink: #222; --paper: #fff; --rule: #ddd; --quiet: #595959; --shade: #0003;
        --note: #fff6e5; --note-ink: #7a4b00; --bad: #fdecea; --bad-ink: #8a1c00; --link: #0059a3;
        --blue: #2166ac; --orange: #b25806; --green: #1e6b3c; --red: #b3261e; --amber: #8a5300;
        --card: #f6f8fa; --pad: #f3e3d3; --limb: #b9bec4; --finger-pad: #e6b8a2; }
.in-dark { display: none; }
@media screen and (prefers-color-scheme: dark) {
  .in-light { display: none; } .in-dark { display: inline; }
  :root { --ink: #e6e6e6; --paper: #191919; --rule: #444; --quiet: #aaa; --shade: #0009;
          --note: #33270f; --note-ink: #ffd58a; --bad: #3a1712; --bad-ink: #ffb4a3; --link: #8ab4f8;
          --blue: #6baed6; --orange: #f1a340; --green: #6fcf97; --red: #ff8f80; --amber: #ffd58a;
          --card: #1d2226; --pad: #3a322a; --limb: #5c636a; --finger-pad: #8a5a44; }
  .plot svg { filter: invert(.93) hue-rotate(180deg) brightness(1.4); }
}
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 70rem; margin: 1.5rem auto; padding: 0 1rem; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.25; margin-bottom: 0; }
h1 + p { max-width: none; } h2 { font-size: 1.15rem; margin-top: 2rem; } a { color: var(--link); } code { overflow-wrap: anywhere; }
p, ul { max-width: 50rem; } .quiet { color: var(--quiet); font-size: .95rem; margin-top: .3rem; }
.note { color: var(--note-ink); background: var(--note); padding: .4rem .8rem; border-left: 4px solid #e69f00; }
.bad { color: var(--bad-ink); background: var(--bad); padding: .4rem .8rem; border-left: 4px solid #d55e00; }
.answers { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 15.5rem), 1fr)); gap: .8rem; margin: 1.2rem 0; }
.answers div { background: var(--card); border: 1px solid var(--rule); border-radius: 10px; padding: .7rem 1rem; }
.answers b { display: block; font-size: 1.35rem; line-height: 1.3; font-variant-numeric: tabular-nums; }
.answers span { color: var(--quiet); font-size: .95rem; } .answers .doubtful b { color: var(--red); }
.verdict { white-space: nowrap; font-weight: 600; } .verdict.good { color: var(--green); }
.verdict.doubtful { color: var(--amber); } .verdict.failed { color: var(--red); }
table { border-collapse: collapse; }
.wide { overflow-x: auto; margin: 1rem 0; background:
  linear-gradient(to right, var(--paper) 40%, transparent) 0 0 / 3rem 100% local no-repeat,
  linear-gradient(to left, var(--paper) 40%, transparent) 100% 0 / 3rem 100% local no-repeat,
  linear-gradient(to right, var(--shade), transparent) 0 0 / .7rem 100% no-repeat,
  linear-gradient(to left, var(--shade), transparent) 100% 0 / .7rem 100% no-repeat; }
th, td { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid var(--rule);
         white-space: nowrap; font-variant-numeric: tabular-nums; }
.figures { display: grid; gap: 1.5rem 2rem; margin: 1.5rem 0; align-items: start;
           grid-template-columns: repeat(auto-fill, minmax(min(100%, 30rem), 1fr)); }
figure { margin: 0; min-width: 0; max-width: 36rem; } .whole-row { grid-column: 1 / -1; max-width: none; }
@media screen and (min-width: 68rem) { .tall { grid-row: span 2; } }
.plot svg { display: block; width: 100%; height: auto; } .narrow-plot { display: none; }
figcaption { color: var(--quiet); font-size: .95rem; margin-top: .3rem; }
.two { display: grid; grid-template-columns: 1.25fr 1fr; gap: 1.6rem; align-items: end; } .two figure { max-width: none; }
.two.top { align-items: start; } .two .figures { grid-template-columns: 1fr; }
.picture { display: grid; grid-template-columns: 4.2rem 1fr; }
.picture > svg { width: 100%; height: 12rem; overflow: hidden; display: block; }
.two .picture > svg { height: 15rem; } .picture > svg.low { height: 7rem; } .picture > svg.strip { height: .8rem; }
.over-time { cursor: crosshair; touch-action: pan-y; }
.ticks { display: flex; flex-direction: column; justify-content: space-between; text-align: right; padding-right: .5rem; position: relative; }
.ticks .zero { position: absolute; right: .5rem; transform: translateY(-50%); }
.ticks, .clock, .pad-words { font-size: .8rem; color: var(--quiet); font-variant-numeric: tabular-nums; line-height: 1.1; }
.ticks, .clock { white-space: nowrap; } .clock, .pad-words { display: flex; justify-content: space-between; gap: 1rem; }
.clock { padding: .3rem 0 0 4.2rem; } .pad-words { padding: .4rem 2.3%; } .pad-words span:last-child { text-align: right; }
.picture path, .picture line { vector-effect: non-scaling-stroke; fill: none; stroke-width: 2; }
.normal { stroke: var(--blue); } .tangential { stroke: var(--orange); } .residual { stroke: var(--ink); }
.picture path.normal-area { fill: var(--blue); opacity: .2; stroke: none; }
.picture path.tangential-area { fill: var(--orange); opacity: .2; stroke: none; }
.picture line.zero { stroke: var(--rule); stroke-width: 1; }
.picture line.cursor { stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 4 3; }
.picture path.centre { stroke: var(--ink); stroke-width: 1.5; opacity: .75; }
.trusted { fill: #2e7d4f; opacity: .35; } .distrusted { fill: var(--red); }
.section { display: block; width: 100%; height: auto; overflow: visible; }
.section text { font: italic 26px system-ui, sans-serif; fill: var(--quiet); }
.pad { fill: var(--pad); } .taxel { fill: var(--ink); } .surface { stroke: var(--ink); stroke-width: 1.5; }
.base { stroke: var(--ink); stroke-width: 4; } .axis path { stroke: var(--quiet); fill: none; stroke-width: 1.5; }
.pressure { fill: var(--blue); opacity: .8; } .drag { stroke: var(--orange); stroke-width: 2.5; fill: none; }
.found { stroke: var(--ink); stroke-width: 2; fill: none; }
.key-normal { color: var(--blue); font-weight: 600; } .key-tangential { color: var(--orange); font-weight: 600; }
.bars { display: grid; grid-template-columns: minmax(7rem, auto) 1fr; gap: .35rem .9rem; align-items: center; }
.bars svg { width: 100%; height: 1.1rem; display: block; overflow: visible; } .bars .value { font-variant-numeric: tabular-nums; }
.bars.valued { grid-template-columns: minmax(7rem, auto) 5rem 1fr; } .bars .own { font-weight: 600; }
.bars rect { shape-rendering: crispEdges;  fill: var(--blue); } .bars rect.tangential { fill: var(--orange); stroke: none; }
.bars rect.least { fill: var(--green); } .bars rect.dim { fill: var(--limb); } .bars rect.room { fill: var(--rule); opacity: .5; }
.bars .scale { grid-column: 2; display: flex; justify-content: space-between; font-size: .8rem; color: var(--quiet); }
.cards table, .cards tbody { display: block; } .cards thead { display: none; } .cards td { border: 0; padding: 0; white-space: normal; min-width: 0; }
.cards tr { display: grid; grid-template-columns: 1fr 1fr 1fr; gap: .3rem 1rem; margin: .7rem 0; padding: .6rem .9rem;
            background: var(--card); border: 1px solid var(--rule); border-radius: 10px; }
.cards td::before { content: attr(data-label); display: block; color: var(--quiet); font-size: .8rem; line-height: 1.2; }
.cards td:first-child { font-weight: 600; }
figure.skin { max-width: none; margin: 0 0 2rem; } .frame[hidden] { display: none; }
.maps { display: grid; gap: 1.2rem 2rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 19rem), 1fr)); align-items: start; }
.maps.small { grid-template-columns: repeat(auto-fit, minmax(min(100%, 13rem), 1fr)); }
.maps > div { min-width: 0; max-width: 36rem; } .map-title { margin: 0 0 .4rem; font-weight: 600; }
.map { display: grid; grid-template-columns: 2.6rem 1fr; } .map > svg { width: 100%; height: auto; display: block; border: 1px solid var(--rule); box-sizing: border-box; }
.map .ends { display: flex; justify-content: space-between; padding-top: .3rem; font-size: .8rem; line-height: 1.1; color: var(--quiet); font-variant-numeric: tabular-nums; }
.map image { image-rendering: pixelated; } .taxel-dot { fill: var(--ink); opacity: .35; } .taxel-dead { fill: none; stroke: var(--ink); stroke-width: 1.6; opacity: .7; }
.arrow, .arrow-rim { fill: none; stroke-linejoin: round; stroke-linecap: round; }
.arrow { stroke: var(--orange); stroke-width: 3; } .arrow-rim { stroke: var(--paper); stroke-width: 6.5; opacity: .85; }
.support { fill: none; stroke: var(--ink); stroke-width: 1.6; }
.colours { display: flex; flex-wrap: wrap; gap: .3rem .6rem; align-items: center; margin-top: .7rem; font-size: .85rem; color: var(--quiet); font-variant-numeric: tabular-nums; }
.ramp { flex: 0 1 14rem; min-width: 6rem; height: .8rem; border: 1px solid var(--rule); } .arrow-key { margin-left: .8rem; white-space: nowrap; }
.arrow-key svg { width: 2.6rem; height: .9rem; vertical-align: -.1rem; } .picture path.true { stroke-dasharray: 5 4; stroke-width: 1.6; }
.hand { width: 100%; max-width: 46rem; max-height: 38rem; display: block; }
.views { display: flex; flex-wrap: wrap; gap: .5rem 2rem; align-items: flex-end; } .views svg { max-width: 100%; }
figure.sheet { max-width: none; }
.views p { margin: .2rem 0; } .hand .axis { stroke: var(--ink); stroke-width: 1.5; } .hand .rim { stroke: var(--ink); stroke-width: 1.5; }
.hand polyline { fill: none; stroke-linecap: round; stroke-linejoin: round; }
.hand .palm { stroke: var(--limb); stroke-width: 22; opacity: .55; } .hand .link { stroke: var(--limb); stroke-width: 13; }
.hand .joint { fill: var(--paper); stroke: var(--ink); stroke-width: 2.5; }
.hand .pad { fill: var(--finger-pad); opacity: .75; } .hand .surface { stroke: var(--ink); stroke-width: 3; }
.hand .grasp { stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 5 5; opacity: .6; }
.hand .cone { fill: var(--ink); opacity: .12; } .hand .contact { fill: var(--ink); }
.hand .shaft { stroke-width: 4; } .hand .held.shaft { stroke-width: 9; opacity: .75; }
.hand .measured { stroke: var(--blue); } .hand .measured.head { fill: var(--blue); }
.hand .held { stroke: var(--orange); } .hand .held.head { fill: var(--orange); }
.hand .load { stroke: var(--green); } .hand .load.head { fill: var(--green); }
.hand .scale { stroke: var(--ink); stroke-width: 2; } .hand .frame { stroke: var(--quiet); stroke-width: 2; }
.hand .frame.head { fill: var(--quiet); }
.hand text { font: 18px system-ui, sans-serif; fill: var(--ink); stroke: none; }
.key-measured { border-bottom: 3px solid var(--blue); } .key-held { border-bottom: 3px solid var(--orange); }
.key-load { border-bottom: 3px solid var(--green); }
input[type=range] { width: 100%; accent-color: var(--blue); margin: 1rem 0 0; }
#answer { font-variant-numeric: tabular-nums; margin: .2rem 0; } #where { font-weight: 600; margin: .2rem 0; }
details { border-top: 1px solid var(--rule); margin-top: 2rem; padding-top: .6rem; } summary { cursor: pointer; font-weight: 600; }
details.note { border-top: 0; margin-top: .6rem; padding: .4rem .8rem; max-width: 50rem; } details.note p { margin: .3rem 0; }
footer { color: var(--quiet); margin-top: 3rem; font-size: .9rem; }
@media screen and (max-width: 64rem) { .two { grid-template-columns: 1fr; } .two figure { max-width: 44rem; } }
@media screen and (max-width: 48rem) {
  body { padding: 0 .6rem; } .wide-plot { display: none; } .narrow-plot { display: block; }
  .picture > svg, .two .picture > svg { height: 13rem; } .section text { font-size: 36px; }
  thead { display: none; } table, tbody { display: block; } td { border: 0; padding: 0; white-space: normal; min-width: 0; }
  tr { display: grid; grid-template-columns: 1fr 1fr; gap: .3rem 1rem; margin: .7rem 0; padding: .6rem .9rem;
       background: var(--card); border: 1px solid var(--rule); border-radius: 10px; }
  td::before { content: attr(data-label); display: block; color: var(--quiet); font-size: .8rem; line-height: 1.2; }
  td:first-child { font-weight: 600; } .bars, .bars.valued { grid-template-columns: 1fr auto; }
  .bars > svg { grid-column: 1 / -1; order: 0; } .bars .scale { grid-column: 1 / -1; }
}
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; } h2 { break-after: avoid; }
  .figures { grid-template-columns: 1fr 1fr; gap: 1rem; } figure, tr, .answers div { break-inside: avoid; }
  figcaption { font-size: 9pt; } table { font-size: 8.5pt; } th, td { padding-right: .5rem; white-space: normal; }
  .wide { overflow: visible; background: none; } #live { display: none; } .picture > svg { height: 4cm; } .section text { font-size: 34px; }
  .answers { grid-template-columns: repeat(4, 1fr); gap: .4rem; } .answers b { font-size: 12pt; }
}
)";
}

}  // namespace tactile_net::pages
