// Everything over time: one cursor and one zoom for all charts, one mark at the frame shown.

/** @param d  what report/json/frames_json.cpp writes */
function makeTimeline(d) {
  const count = d.frames.number.length;
  const rises = d.frames.time &&
      d.frames.time.every((t, i, all) => t !== null && (i === 0 || t > all[i - 1]));
  // Times since 1970 have no room on an axis: they are counted from the first frame's.
  const zero = rises && Math.abs(d.frames.time[0]) > 1e5 ? d.frames.time[0] : 0;
  const xs = rises ? d.frames.time.map((t) => t - zero) : d.frames.number;
  const label = rises ? zero ? `seconds after ${zero} s` : 'time' : 'frame';
  const charts = [], listeners = [];
  const gaps = new Set(d.frames.gaps);
  const column = columnsOf(xs, gaps);
  const range = [xs[0], xs[count - 1]];
  const near = (x) => {
    let low = 0, high = count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      xs[middle] < x ? low = middle : high = middle;
    }
    return x - xs[low] < xs[high] - x ? low : high;
  };
  const linked = {
    key: 'time',
    near,
    zoom: (low, high) => {
      for (const chart of charts) chart.view(low, high);
      for (const listen of listeners) listen(low, high);
    },
  };
  return {
    column,
    count,
    label,
    onPick: null,
    /** A chart over the frames. @param say  words for a frame */
    chart(place, spec, say, behind) {
      const chart = makeChart(
          place, {
            height: 190,
            ...spec,
            xs,
            gaps,
            x: {label: '', suffix: rises ? ' s' : '', whole: !rises, range}
          },
          {behind, linked: {...linked, say}});
      chart.onPick = (x) => this.onPick?.(near(x));
      charts.push(chart);
      return chart;
    },
    /** A strip of what each frame's verdict is: good or bad. */
    strip(place) {
      const canvas = element(
          'canvas',
          {class: 'strip', height: 1, role: 'img', 'aria-label': 'Verdict of every frame'});
      place.append(canvas);
      let view = range;
      const draw = () => {
        const width = canvas.width = Math.max(1, canvas.clientWidth),
              context = canvas.getContext('2d');
        const at = (x) => width * (x - view[0]) / (view[1] - view[0]);
        for (let i = 0; i < count; ++i) {
          context.fillStyle = ink(d.frames.distrusted[i] ? '--red' : '--trusted');
          const [left, right] = column(i).map((x) => Math.floor(at(x)));
          context.fillRect(left, 0, Math.max(1, right - left), 1);
        }
      };
      listeners.push((low, high) => {
        view = [low, high];
        draw();
      });
      new ResizeObserver(draw).observe(canvas);
      whenColoursChange(draw);
      canvas.addEventListener('click', (event) => {
        const box = canvas.getBoundingClientRect();
        this.onPick?.(near(view[0] + (view[1] - view[0]) * (event.clientX - box.left) / box.width));
      });
    },
    mark(frame) {
      for (const chart of charts) chart.mark(xs[frame]);
    },
  };
}

/**
 * Where the column of each x begins and ends: half way to its neighbours, or at an end or a gap as
 * far as on the other side. @param gaps  indices before which something is missing
 */
function columnsOf(xs, gaps = new Set()) {
  const least = xs.reduce((most, x, i) => i ? Math.min(most, x - xs[i - 1]) : most, Infinity);
  const apart = (i) => i > 0 && i < xs.length && !gaps.has(i) ? xs[i] - xs[i - 1] : NaN;
  return (i) => {
    const before = apart(i), after = apart(i + 1), alone = Number.isFinite(least) ? least : 1;
    const or = (one, other) => Number.isNaN(one) ? Number.isNaN(other) ? alone : other : one;
    return [xs[i] - or(before, after) / 2, xs[i] + or(after, before) / 2];
  };
}

/** Draws a column of colours a frame, between the edges of its time. */
function heatMap(time, rows, value, most, palette, low, high) {
  const canvas = element('canvas', {width: time.count, height: rows});
  const fill = () => {
    const context = canvas.getContext('2d'), image = context.createImageData(time.count, rows);
    const values = new Float32Array(time.count * rows);
    for (let frame = 0; frame < time.count; ++frame)
      for (let row = 0; row < rows; ++row)
        values[(rows - 1 - row) * time.count + frame] = value(frame, row);
    paint(image, values, most, palette);
    context.putImageData(image, 0, 0);
  };
  fill();
  whenColoursChange(fill);
  return (plot, context) => {
    const y = plot.valToPos(high, 'y', true), tall = plot.valToPos(low, 'y', true) - y;
    context.imageSmoothingEnabled = false;
    for (let frame = 0; frame < time.count; ++frame) {
      const [left, right] = time.column(frame);
      const x = Math.floor(plot.valToPos(left, 'x', true));
      const wide = Math.ceil(plot.valToPos(right, 'x', true)) - x;
      if (x + wide >= plot.bbox.left && x <= plot.bbox.left + plot.bbox.width)
        context.drawImage(canvas, frame, 0, 1, rows, x, y, wide, tall);
    }
  };
}
