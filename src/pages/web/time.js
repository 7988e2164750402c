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
  const edge = edgesOf(xs);
  const range = [edge(0), edge(count)];
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
    xs,
    edge,
    range,
    count,
    label,
    onPick: null,
    /** A chart over the frames. @param say  words for a frame */
    chart(place, spec, say, behind) {
      const chart = makeChart(
          place, {height: 190, ...spec, xs, x: {label: '', suffix: rises ? ' s' : '', range}},
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
          const left = Math.floor(at(edge(i)));
          context.fillRect(left, 0, Math.max(1, Math.floor(at(edge(i + 1))) - left), 1);
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

/** Where the column of each x begins: half way from the one before. */
function edgesOf(xs) {
  const last = xs.length - 1;
  return (i) => i <= 0 ? xs[0] - (xs[1] - xs[0] || 1) / 2 :
      i > last         ? xs[last] + (xs[last] - xs[last - 1] || 1) / 2 :
                         (xs[i - 1] + xs[i]) / 2;
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
      const x = Math.floor(plot.valToPos(time.edge(frame), 'x', true));
      const wide = Math.ceil(plot.valToPos(time.edge(frame + 1), 'x', true)) - x;
      if (x + wide >= plot.bbox.left && x <= plot.bbox.left + plot.bbox.width)
        context.drawImage(canvas, frame, 0, 1, rows, x, y, wide, tall);
    }
  };
}
