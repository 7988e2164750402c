// Curves in axes. uPlot makes the axes, the grid, the cursor and the zoom; curves, bands, marks and
// names are drawn here, since each curve may have an x of its own.

const curveColours = {
  light: ['#000000', '#0072b2', '#d55e00', '#009e73', '#b0578d', '#b87700'],
  dark: ['#f0f0f0', '#56b4e9', '#ff9a4d', '#2fce9f', '#e39ac4', '#f0b840'],
};
const named = {
  normal: '--blue',
  tangential: '--orange',
  third: '--green',
  ink: '--ink',
  quiet: '--quiet'
};
/** The same number is the same colour in every picture; 0 is the truth's. */
const colourOf = (curve) => curve.quiet ? ink('--limb') :
    named[curve.colour]                 ? ink(named[curve.colour]) :
                          curveColours[darkNow() ? 'dark' : 'light'][(curve.colour ?? 0) % 6];

/** The least and the greatest of finite numbers, where `positive` of those above 0. */
function rangeOf(lists, positive) {
  let low = Infinity, high = -Infinity;
  for (const list of lists)
    for (const value of list)
      if (value !== null && Number.isFinite(value) && (!positive || value > 0)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
  return low <= high ? [low, high] : positive ? [0.1, 1] : [0, 1];
}

/** What an axis reaches over: all values, and some room. */
function axisRange(axis, lists, within) {
  let [low, high] = rangeOf(lists, axis.log);
  if (within) {
    const ends = [Math.min(low, 0), Math.max(high, 0)].map((end) => Math.asinh(end / within));
    const room = Math.max(0.08 * (ends[1] - ends[0]), 0.5);
    return [within * Math.sinh(ends[0] - room), within * Math.sinh(ends[1] + room)];
  }
  if (axis.log) {
    const room = Math.max((high / low) ** 0.04, 1.1);
    return [low / room, high * room];
  }
  if (axis.end) return [0, axis.end];
  if (axis.from_zero) low = Math.min(0, low);
  if (axis.at_least) {
    low = Math.min(low, -axis.at_least);
    high = Math.max(high, axis.at_least);
  }
  if (!(high > low))
    [low, high] = [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
  const room = axis.tight ? 0 : 0.04 * (high - low);
  return [axis.from_zero && low === 0 ? 0 : low - room, high + room];
}

/** Distances of ticks that are whole numbers. */
const wholeSteps =
    Array.from({length: 10}, (_, power) => [1, 2, 5].map((digit) => digit * 10 ** power)).flat();

/** Ticks of a logarithmic axis: powers of ten, or 1, 2 and 5 of these where they are few. */
function logarithmicTicks(low, high) {
  const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
  const digits = Math.log10(high / low) < 2.5 ? [1, 2, 5] : [1];
  const step = Math.max(1, Math.ceil((last - first) / 7));
  const ticks = [];
  for (let power = first; power <= last; power += step)
    for (const digit of digits) ticks.push(digit * 10 ** power);
  const within = ticks.filter((tick) => tick >= low && tick <= high);
  if (within.length > 1) return within;
  // Less than a step of these lies between: even ticks.
  const power = 10 ** Math.floor(Math.log10(high - low));
  const even = power * [0.2, 0.5, 1, 2].find((size) => (high - low) / (size * power) <= 5);
  return Array.from(
      {length: Math.floor(high / even) - Math.ceil(low / even) + 1},
      (_, i) => Number(((Math.ceil(low / even) + i) * even).toPrecision(9)));
}

/** Ticks of an axis that is linear within a range and logarithmic on both sides of it. */
function bothSidedTicks(low, high, within) {
  const first = Math.ceil(Math.log10(within)), last = Math.floor(Math.log10(Math.max(-low, high)));
  const step =
      Math.max(1, Math.ceil((last - first + 1) / (low < -within && high > within ? 3 : 5)));
  const ticks = [0];
  for (let power = last; power >= first; power -= step)
    for (const tick of [10 ** power, -(10 ** power)])
      if (tick >= low && tick <= high) ticks.push(tick);
  return ticks.sort((a, b) => a - b);
}

/**
 * A chart in `place`.
 *
 * @param spec {x: {label, log, ...}, y: {...}, curves: [{label, colour, x, y, band, dots, marks,
 *   dashed, width, quiet, names}], linear_within, quiet_label, band_label, height, gaps}; `gaps`:
 *   indices before which the curves are broken; bands of dots are bars
 * @param behind  draws on the canvas before the curves: (uPlot, context)
 */
function makeChart(place, spec, {behind = null, linked = null} = {}) {
  // Rows of a map are no curves.
  const {map, curves: rows} = spec;
  if (map) {
    const column = columnsOf(spec.xs), count = spec.xs.length;
    spec.curves = [];
    spec.x.range = [spec.xs[0], spec.xs[count - 1]];
    spec.value = spec.y.label;
    spec.y = {label: map.label, range: [map.low, map.high]};
    behind = heatMap(
        {count, column}, rows.length, (at, row) => rows[row].y[at] ?? NaN, map.most, 'signed',
        map.low, map.high);
  }
  /** The value of a map under the pointer. */
  const sayMap = (x, y) => {
    const row = Math.floor(rows.length * (y - map.low) / (map.high - map.low));
    const column = spec.xs.reduce(
        (best, one, i) => Math.abs(one - x) < Math.abs(spec.xs[best] - x) ? i : best, 0);
    return `${spec.x.label} ${brief(spec.xs[column], 4)}, ${rows[row]?.label ?? ''}: ` +
        `${spec.value} ${brief(rows[row]?.y[column] ?? NaN)}`;
  };
  let curves = [], ranges = {};
  const curveX = (curve) => curve.x ?? spec.xs;
  const edges = (curve) => curve.band ?
      [
        curve.y.map((y, i) => y === null ? null : y - curve.band[i]),
        curve.y.map((y, i) => y === null ? null : y + curve.band[i])
      ] :
      curve.low ? [curve.low, curve.high] :
                  null;
  const take = (all) => {
    curves = all;
    for (const curve of curves) curve.edges = edges(curve);
    ranges = {
      x: spec.x.range ?? axisRange(spec.x, curves.map(curveX), spec.linear_within),
      y: spec.y.range ??
          axisRange(spec.y, curves.flatMap((c) => [c.y, ...(c.edges ?? [])]), spec.linear_within)
    };
  };
  take(spec.curves);

  const plotBox =
      element('div', {class: 'plot-box', role: 'img', 'aria-label': spec.name ?? spec.y.label});
  const readout = element('p', {class: 'readout'}, ' ');
  const legend = element('p', {class: 'legend'});
  place.append(plotBox, readout, legend);

  const broken = (i) => spec.gaps?.has(i) ?? false;
  let plot = null, marked = null;
  const marker = element('i', {class: 'marker', hidden: ''});

  function stroke(context, plotted, curve, values) {
    const xs = curveX(curve);
    const at = (i) => [plotted.valToPos(xs[i], 'x', true), plotted.valToPos(values[i], 'y', true)];
    const known = (i) => values[i] !== null && Number.isFinite(values[i]) && xs[i] !== null &&
        (!spec.y.log || values[i] > 0) && (!spec.x.log || xs[i] > 0);
    return {xs, at, known};
  }

  function drawBand(context, plotted, curve) {
    const [low, high] = curve.edges;
    const {at, known} = stroke(context, plotted, curve, low);
    const top = stroke(context, plotted, curve, high);
    context.fillStyle = context.strokeStyle = colourOf(curve);
    const path = new Path2D();
    if (curve.dots) {
      context.lineWidth = 1.5 * (devicePixelRatio || 1);
      for (let i = 0; i < low.length; ++i) {
        if (!known(i) || !top.known(i)) continue;
        path.moveTo(...at(i));
        path.lineTo(...top.at(i));
      }
      context.stroke(path);
      return;
    }
    context.globalAlpha = 0.2;
    for (let first = 0; first < low.length; ++first) {
      let end = first;
      while (end < low.length && known(end) && top.known(end) && (end === first || !broken(end)))
        ++end;
      if (end === first) continue;
      for (let i = first; i < end; ++i)
        i === first ? path.moveTo(...top.at(i)) : path.lineTo(...top.at(i));
      for (let i = end; i-- > first;) path.lineTo(...at(i));
      path.closePath();
      first = end - 1;
    }
    context.fill(path);
    context.globalAlpha = 1;
  }

  function drawCurve(context, plotted, curve) {
    const fine = devicePixelRatio || 1;
    const {at, known} = stroke(context, plotted, curve, curve.y);
    context.strokeStyle = context.fillStyle = colourOf(curve);
    context.lineWidth = fine * (curve.width || (curve.quiet ? 1 : 2));
    context.setLineDash(curve.dashed ? [6 * fine, 4 * fine] : []);
    context.lineJoin = 'round';
    const line = new Path2D(), dots = new Path2D();
    const radius = fine * (curve.quiet ? 1.8 : curve.dots ? 2.5 : 3);
    for (let i = 0, pen = false; i < curve.y.length; ++i) {
      if (broken(i)) pen = false;
      if (!known(i)) {
        pen = false;
        continue;
      }
      const [x, y] = at(i);
      pen ? line.lineTo(x, y) : line.moveTo(x, y);
      const lone = !pen && (i + 1 === curve.y.length || !known(i + 1) || broken(i + 1));
      if (curve.dots || curve.marks || curve.quiet || lone) {
        dots.moveTo(x + radius, y);
        dots.arc(x, y, radius, 0, 7);
      }
      pen = true;
    }
    if (!curve.dots) context.stroke(line);
    context.fill(dots);
    context.setLineDash([]);
  }

  /** Words at points, from the lowest point upwards, none over another. */
  function drawNames(context, plotted) {
    const fine = devicePixelRatio || 1, line = 15 * fine;
    context.font = `${12 * fine}px system-ui, sans-serif`;
    context.textAlign = 'left';
    context.textBaseline = 'alphabetic';
    const names =
        curves.flatMap((curve) => (curve.names ?? []).map((text, i) => ({text, curve, i})))
            .filter((one) => one.text)
            .map((one) => ({
                   ...one,
                   x: plotted.valToPos(curveX(one.curve)[one.i], 'x', true),
                   y: plotted.valToPos(one.curve.y[one.i], 'y', true)
                 }))
            .sort((a, b) => b.y - a.y);
    let free = Infinity;
    for (const {text, curve, x, y} of names) {
      const down = Math.max(Math.min(y - line, free), plotted.bbox.top + line);
      free = down - line;
      const width = context.measureText(text).width;
      const left = Math.max(
          plotted.bbox.left,
          Math.min(x + 4 * fine, plotted.bbox.left + plotted.bbox.width - width));
      context.strokeStyle = ink('--quiet');
      context.lineWidth = 0.7 * fine;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x, down + 3 * fine);
      context.stroke();
      context.fillStyle = colourOf(curve);
      context.beginPath();
      context.arc(x, y, 3.5 * fine, 0, 7);
      context.fill();
      context.strokeStyle = ink('--paper');
      context.lineWidth = 3 * fine;
      context.strokeText(text, left, down);
      context.fillStyle = ink('--ink');
      context.fillText(text, left, down);
    }
  }

  function drawAll(plotted) {
    const context = plotted.ctx, {left, top, width, height} = plotted.bbox;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    behind?.(plotted, context);
    for (const curve of curves)
      if (curve.edges) drawBand(context, plotted, curve);
    for (const quiet of [true, false])
      for (const curve of curves)
        if (!!curve.quiet === quiet) drawCurve(context, plotted, curve);
    drawNames(context, plotted);
    context.restore();
    placeMarker();
  }

  function placeMarker() {
    if (!plot) return;
    const x = marked === null ? -1 : plot.valToPos(marked, 'x');
    marker.hidden = !(x >= 0 && x <= plot.over.clientWidth);
    marker.style.left = `${x}px`;
  }

  const valueOf = (curve, i) => {
    const text = brief(curve.y[i], 4), [low, high] = curve.edges?.map((ends) => ends[i]) ?? [0, 0];
    const up = high - curve.y[i], down = curve.y[i] - low;
    if (!(high > low)) return text;
    return Math.abs(up - down) < 1e-3 * (up + down) ?
        `${text} ± ${brief(up, 2)}` :
        `${text} (${brief(low, 4)} to ${brief(high, 4)})`;
  };
  /**
   * Every curve at the x nearest to the pointer; nothing where they are many, or have an x each.
   */
  function sayAll(plotted, left) {
    const xs = curveX(curves[0]);
    if (curves.length > 6 || curves.some((curve) => curveX(curve) !== xs || curve.names)) return '';
    const x = plotted.posToVal(left, 'x');
    const at =
        xs.reduce((best, one, i) => Math.abs(one - x) < Math.abs(xs[best] - x) ? i : best, 0);
    const known = curves.filter((curve) => Number.isFinite(curve.y[at]));
    return `${spec.x.label} ${brief(xs[at], 4)}, ${spec.y.label}: ` +
        known.map((curve) => `${curve.label} ${valueOf(curve, at)}`).join(', ');
  }
  function sayNearest(plotted, left, top) {
    let best = 40, text = ' ';
    for (const curve of curves)
      for (let i = 0; i < curve.y.length; ++i) {
        const x = curveX(curve)[i];
        const away =
            Math.hypot(plotted.valToPos(x, 'x') - left, plotted.valToPos(curve.y[i], 'y') - top);
        if (!(away < best)) continue;
        best = away;
        text = `${curve.names?.[i] || curve.label}: ${spec.x.label} ${brief(x, 4)}, ${
            spec.y.label} ${valueOf(curve, i)}`;
      }
    return text;
  }

  /** What the pointer reads. */
  function say(plotted) {
    const {left, top} = plotted.cursor;
    readout.textContent = !(left >= 0) ? ' ' :
        map    ? sayMap(plotted.posToVal(left, 'x'), plotted.posToVal(top, 'y')) :
        linked ? linked.say(linked.near(plotted.posToVal(left, 'x'))) :
                 sayAll(plotted, left) || sayNearest(plotted, left, top);
  }

  function axisOf(axis, side) {
    const isX = side === 'x';
    const splits = spec.linear_within ?
        (_, __, low, high) => bothSidedTicks(low, high, spec.linear_within) :
        axis.log ? (_, __, low, high) => logarithmicTicks(low, high) :
                   undefined;
    return {
      scale: side,
      ...(splits ? {splits, filter: (_, all) => all} : {}),
      ...(axis.whole ? {incrs: wholeSteps} : {}),
      stroke: () => ink('--quiet'),
      font: '12px system-ui, sans-serif',
      labelFont: '12px system-ui, sans-serif',
      ...(axis.label ? {label: axis.label, labelSize: 20, labelGap: 2} : {}),
      size: isX ? 30 : 62,
      space: isX ? 60 : 34,
      grid: {stroke: () => ink('--rule'), width: 1},
      ticks: {stroke: () => ink('--rule'), width: 1, size: 4},
      values: (_, all) =>
          all.map((value) => value === null ? '' : brief(value, 6) + (axis.suffix ?? ''))
    };
  }
  const scaleOf = (axis, side) => ({
    time: false,
    auto: false,
    distr: spec.linear_within ? 4 :
        axis.log              ? 3 :
                                1,
    asinh: spec.linear_within || 1,
    range: (_, low, high) => low === null || !(high > low) ? ranges[side] : [low, high]
  });

  function build() {
    plot?.destroy();
    const drag = {x: true, y: !linked, uni: 20, dist: 6};
    plot = new uPlot(
        {
          width: Math.max(plotBox.clientWidth, 200),
          height: spec.height ?? 300,
          padding: [8, linked ? 24 : 12, 0, 0],  // "0.065 s" at the end of an axis
          legend: {show: false},
          cursor: {drag, points: {show: false}, ...(linked ? {sync: {key: linked.key}} : {})},
          scales: {x: scaleOf(spec.x, 'x'), y: scaleOf(spec.y, 'y')},
          axes: [axisOf(spec.x, 'x'), axisOf(spec.y, 'y')],
          series: [{}, {scale: 'y', paths: () => null, points: {show: false}}],
          hooks: {
            draw: [drawAll],
            setCursor: [say],
            setScale: [(self, key) => {
              if (linked && key === 'x') linked.zoom(self.scales.x.min, self.scales.x.max);
            }]
          },
        },
        [ranges.x, ranges.y], plotBox);
    plot.setScale('x', {min: ranges.x[0], max: ranges.x[1]});
    plot.setScale('y', {min: ranges.y[0], max: ranges.y[1]});
    plot.over.append(marker);
    plot.over.addEventListener('dblclick', () => chart.all());
    let down = 0;
    plot.over.addEventListener('pointerdown', (event) => {
      down = event.clientX;
    });
    plot.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - down) < 6) chart.onPick?.(plot.posToVal(plot.cursor.left, 'x'));
    });
  }

  function drawLegend() {
    const entry = (curve, label) => {
      const sign = element('i', {class: curve.dots ? 'dot' : curve.dashed ? 'dashed' : 'line'});
      sign.style.color = colourOf(curve);
      return element('span', {}, sign, label);
    };
    const shown = curves.filter((curve) => !curve.quiet && curve.label);
    const all =
        shown.length > 1 || spec.band_label ? shown.map((curve) => entry(curve, curve.label)) : [];
    const quiet = curves.find((curve) => curve.quiet);
    if (quiet && spec.quiet_label) all.push(entry(quiet, spec.quiet_label));
    if (spec.band_label) all.push(element('span', {}, `bands: ${spec.band_label}`));
    legend.replaceChildren(...all);
  }

  const chart = {
    onPick: null,
    setCurves(all) {
      take(all);
      plot.setScale('y', {min: ranges.y[0], max: ranges.y[1]});
      plot.redraw();
      drawLegend();
    },
    /** The same curves with other values, in the same axes. */
    update(all) {
      curves = all;
      for (const curve of curves) curve.edges = edges(curve);
      plot.redraw(false);
    },
    mark(x) {
      marked = x;
      placeMarker();
    },
    view(low, high) {
      if (plot.scales.x.min !== low || plot.scales.x.max !== high)
        plot.setScale('x', {min: low, max: high});
    },
    all() {
      plot.setScale('x', {min: ranges.x[0], max: ranges.x[1]});
      plot.setScale('y', {min: ranges.y[0], max: ranges.y[1]});
    },
    redraw: () => plot.redraw(),
  };
  build();
  drawLegend();
  const fit = () => {
    const width = plotBox.clientWidth;
    if (width > 0 && Math.abs(width - plot.width) > 1)
      plot.setSize({width, height: spec.height ?? 300});
  };
  new ResizeObserver(fit).observe(plotBox);
  addEventListener('beforeprint', fit);
  whenColoursChange(() => {
    plot.redraw();
    drawLegend();
  });
  return chart;
}
