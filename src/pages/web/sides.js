// A curved skin from three sides, along the sensor's axes: cells are quadrilaterals with the map's
// colours, the farthest drawn first, and those that face away are faint.

/**
 * Three drawings in `place`. @param d  what report/json/frames_json.cpp writes, with its `surface`
 * @param on {say(cell), point(cell or null), pick(cell)}
 */
function makeSides(place, d, on) {
  const {rows, columns} = d.grid, {corners, step, length, taxels, forces} = d.surface;
  const across = columns + 1, names = ['x', 'y', 'z'];
  const cornersOf = (cell) => {
    const first = Math.floor(cell / columns) * across + cell % columns;
    return [first, first + 1, first + across + 1, first + across];
  };
  const cells = Array.from({length: rows * columns}, (_, cell) => {
    const at = cornersOf(cell);
    const along = (from, to) => corners.map((axis) => axis[at[to]] - axis[at[from]]);
    const [a, b] = [along(0, 2), along(3, 1)];
    return {
      at,
      // Its area times its outward normal, twice.
      outward:
          [0, 1, 2].map((k) => a[(k + 2) % 3] * b[(k + 1) % 3] - a[(k + 1) % 3] * b[(k + 2) % 3])
    };
  });
  const cellOf = (i) => {
    const index = (value, first, by, count) =>
        Math.max(0, Math.min(count - 1, Math.round((value - first) / by)));
    return index(d.taxels.y[i], d.grid.y, d.grid.dy, rows) * columns +
        index(d.taxels.z[i], d.grid.z, d.grid.dz, columns);
  };
  const rangeAlong = (axis) => rangeOf([corners[axis]]);
  const reach = Math.max(...[0, 1, 2].map((k) => rangeAlong(k)[1] - rangeAlong(k)[0]));
  /** Where a frame's arrow ends; the largest force has half the surface's length. */
  const tipOf = ({force, at}) => {
    const size = Math.hypot(...force), long = 0.5 * reach * Math.min(1, size / d.surface.largest);
    return at.map((x, k) => x + (size > 0 ? long * force[k] / size : 0));
  };
  const arrows = forces.map((one) => one && {at: one.at, tip: tipOf(one)});

  /** The side of an axis on which more of the surface is seen; where neither is, the usual one. */
  const sideOf = (axis) => {
    const sum = cells.reduce((all, cell) => all + cell.outward[axis], 0);
    const size = cells.reduce((all, cell) => all + Math.hypot(...cell.outward), 0);
    return Math.abs(sum) > 0.05 * size ? Math.sign(sum) : axis === 1 ? -1 : 1;
  };
  const views = [0, 1, 2].map((axis) => {
    const side = sideOf(axis), up = axis === 2 ? 1 : 2, right = axis === 0 ? 1 : 0;
    return {axis, side, up, right, mirrored: axis === 1 ? -side : side};
  });
  const extent = (axis) => {
    const ends = arrows.filter(Boolean).flatMap(({at, tip}) => [at[axis], tip[axis]]);
    return rangeOf([corners[axis], ends]);
  };
  const wide = 1.1 * Math.max(...views.map(({right}) => extent(right)[1] - extent(right)[0]));
  const draw = (tag, attributes) => {
    const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [name, value] of Object.entries(
             {'vector-effect': 'non-scaling-stroke', ...attributes}))
      made.setAttribute(name, value);
    return made;
  };
  const readout = element('p', {class: 'readout'}, ' ');
  const numbers = element('p', {class: 'quiet'});
  const line = {fill: 'none', 'stroke-linecap': 'round', 'stroke-linejoin': 'round'};

  for (const view of views) {
    const {axis, side, up, right, mirrored} = view;
    const tall = Math.max(1.1 * (extent(up)[1] - extent(up)[0]), 0.4 * wide);
    const middle = (k) => (extent(k)[0] + extent(k)[1]) / 2;
    const onto = (point) => [mirrored * (point[right] - middle(right)) + wide / 2,
                             tall / 2 - point[up] + middle(up)]
                                .map(Math.round);
    const corner = (i) => onto(corners.map((one) => one[i]));
    view.onto = onto;
    view.facing = (cell) => side * cells[cell].outward[axis] > 0;
    view.edge = (from, to) => `M${corner(from)}L${corner(to)}`;
    const depth = (cell) => side * cells[cell].at.reduce((all, i) => all + corners[axis][i], 0);
    const order = cells.map((_, cell) => cell)
                      .sort((a, b) => view.facing(a) - view.facing(b) || depth(a) - depth(b));
    view.svg = draw('svg', {viewBox: `0 0 ${Math.ceil(wide)} ${Math.ceil(tall)}`, role: 'img'});
    view.svg.style.cssText =
        'display:block;box-sizing:border-box;width:100%;border:1px solid var(--rule);cursor:crosshair';
    view.cells = [];
    for (const cell of order) {
      const path = draw('path', {
        d: `M${cells[cell].at.map(corner).join('L')}Z`,
        stroke: 'var(--limb)',
        'stroke-width': 0.4,
        opacity: view.facing(cell) ? 1 : 0.35
      });
      path.cell = cell;
      view.cells[cell] = path;
    }
    const dots = [], crosses = [];
    const small = 0.012 * wide;
    for (let i = 0; i < taxels[0].length; ++i) {
      if (!view.facing(cellOf(i))) continue;
      const [x, y] = onto(taxels.map((one) => one[i]));
      if (d.taxels.dead.includes(i))
        crosses.push(`M${x - small} ${y - small}l${2 * small} ${2 * small}m0 ${- 2 * small}l${
            - 2 * small} ${2 * small}`);
      else if (taxels[0].length <= mostDots)
        dots.push(`M${x} ${y}h0`);
    }
    const marks = {...line, stroke: 'var(--ink)', 'pointer-events': 'none'};
    view.outline = draw('path', {...marks, 'stroke-width': 1.4});
    view.halo = draw('path', {...marks, stroke: 'var(--paper)', 'stroke-width': 5});
    view.arrow = draw('path', {...marks, 'stroke-width': 2.2});
    view.svg.append(
        ...order.map((cell) => view.cells[cell]),
        draw('path', {...marks, d: dots.join(''), 'stroke-width': 2.6, opacity: 0.5}),
        draw('path', {...marks, d: crosses.join(''), 'stroke-width': 1.4, opacity: 0.8}),
        view.outline, view.halo, view.arrow);
    view.svg.addEventListener('pointermove', (event) => hover(event.target.cell));
    view.svg.addEventListener('pointerleave', () => hover());
    view.svg.addEventListener(
        'click', (event) => event.target.cell !== undefined && on.pick(event.target.cell));
    const at = (k, pixels) => brief((middle(k) + pixels) * step * length.factor);
    const ends = [-wide / 2, wide / 2].map((x) => at(right, mirrored * x));
    const spans = (...all) => all.map((text) => element('span', {}, text));
    view.title = `Seen from ${side > 0 ? '+' : '−'}${names[axis]}`;
    view.place = element(
        'div', {}, element('p', {class: 'map-title'}, view.title),
        element(
            'div', {class: 'map'},
            element(
                'div', {class: 'ticks'},
                ...spans(at(up, tall / 2), `${names[up]} ↑`, at(up, -tall / 2))),
            view.svg, element('i'),
            element(
                'div', {class: 'ends'},
                ...spans(
                    ends[0], mirrored > 0 ? `${names[right]} →` : `← ${names[right]}`,
                    `${ends[1]} ${length.label}`))));
  }
  place.style.gridTemplateColumns = 'repeat(auto-fit, minmax(min(100%, 13rem), 1fr))';
  place.replaceChildren(...views.map((view) => view.place));
  place.after(numbers, readout);

  let shown = null;
  function hover(cell) {
    on.point(cell ?? null);
    readout.textContent = cell === undefined ? ' ' : on.say(cell);
  }

  /** Around the cells that touch, where they are seen. */
  function outlineOf(view) {
    const inside = (row, column) => row >= 0 && column >= 0 && row < rows && column < columns &&
        shown.touching(row * columns + column);
    let path = '';
    for (let row = 0; row < rows; ++row)
      for (let column = 0; column < columns; ++column) {
        const cell = row * columns + column;
        if (!shown.touching(cell) || !view.facing(cell)) continue;
        const [a, b, c, e] = cells[cell].at;
        if (!inside(row - 1, column)) path += view.edge(a, b);
        if (!inside(row, column + 1)) path += view.edge(b, c);
        if (!inside(row + 1, column)) path += view.edge(c, e);
        if (!inside(row, column - 1)) path += view.edge(e, a);
      }
    return path;
  }

  /**
   * An arrow; along the line of sight a ring, with a dot where it comes and a cross where it goes.
   */
  function arrowOf(view, {at, tip}) {
    const [x, y] = view.onto(at), [endX, endY] = view.onto(tip);
    const long = Math.hypot(endX - x, endY - y), head = 0.035 * wide;
    if (long > head) {
      const [u, v] = [head * (endX - x) / long, head * (endY - y) / long];
      return `M${x} ${y}L${endX} ${endY}M${endX - u - v / 2} ${endY - v + u / 2}L${endX} ${endY}` +
          `L${endX - u + v / 2} ${endY - v - u / 2}`;
    }
    const r = 0.6 * head, c = 0.7 * r;
    const ring = `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${- 2 * r} 0`;
    return ring +
        (view.side * (tip[view.axis] - at[view.axis]) > 0 ?
             `M${x} ${y}h0` :
             `M${x - c} ${y - c}l${2 * c} ${2 * c}m0 ${- 2 * c}l${- 2 * c} ${2 * c}`);
  }

  function paintCells() {
    const bytes = new Uint8Array(pixelsOf('signed').buffer);
    const colours = Array.from({length: 256}, (_, i) => `rgb(${bytes.slice(4 * i, 4 * i + 3)})`);
    for (const view of views)
      for (let cell = 0; cell < cells.length; ++cell) {
        const index = Math.round(127.5 * (1 + shown.values[cell] / d.largest.normal));
        const colour = Number.isNaN(index) ? 'none' : colours[Math.max(0, Math.min(255, index))];
        const path = view.cells[cell];
        if (path.colour !== colour) path.setAttribute('fill', path.colour = colour);
      }
  }
  whenColoursChange(() => shown && paintCells());

  return {
    /** @param touching  whether a cell touches; null: not known */
    show(frame, values, touching) {
      shown = {values, touching};
      paintCells();
      const words = forces[frame]?.words ?? 'nothing presses';
      numbers.textContent = words;
      for (const view of views) {
        view.svg.setAttribute('aria-label', `The surface, ${view.title.toLowerCase()}: ${words}`);
        view.outline.setAttribute('d', touching ? outlineOf(view) : '');
        const arrow = arrows[frame] ? arrowOf(view, arrows[frame]) : '';
        view.halo.setAttribute('d', arrow);
        view.arrow.setAttribute('d', arrow);
      }
    }
  };
}
