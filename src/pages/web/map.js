// A skin seen from outside: y to the right, z downwards. A cell is a rectangle of one colour, for
// nothing lies between cells that was solved for; drags are arrows.

const mostArrows = 24;  // along the longer side: of more cells some share an arrow
const mostDots = 2048;  // of more taxels dots would be a grey sheet

/**
 * A map in `place`. @param grid {rows, columns, y, z, dy, dz}: cells row after row along y
 * @param said {title, label, palette, half, length, ends?, where?}; `half`: no values below 0;
 *   `ends` {y: [first, last], along, z: [first, last]} and `where`(row, column) are words where y
 *   and z are no places
 */
function makeMap(place, grid, said) {
  const width = grid.rows * grid.dy, height = grid.columns * grid.dz;
  const cells = element('canvas', {class: 'cells', width: grid.rows, height: grid.columns});
  const above = element('canvas', {class: 'above', role: 'img', 'aria-label': said.label});
  const mark = element('i', {class: 'mark', hidden: ''});
  const box = element('div', {class: 'map-box'}, cells, above, mark);
  box.style.aspectRatio = `${width} / ${height}`;
  const length = (x) => brief(x * said.length.factor);
  const edges =
      (first, step, count) => [first - step / 2, first - step / 2 + step * count].map(length);
  const where = said.where ??
      ((row, column) => `y ${length(placeOfCell(grid.y, grid.dy, row))}, z ${
           length(placeOfCell(grid.z, grid.dz, column))} ${said.length.label}`);
  let {y: [left, right], along = 'y →', z: [top, bottom]} =
      said.ends ?? {y: edges(grid.y, grid.dy, grid.rows), z: edges(grid.z, grid.dz, grid.columns)};
  if (!said.ends) right += ` ${said.length.label}`;
  const spans = (...all) => all.map((text) => element('span', {}, text));
  const readout = element('p', {class: 'readout'}, ' ');
  const ramp = element('span', {class: 'ramp'});
  const [low, high, key] = spans('', '', '');
  const bar = element('div', {class: 'colours'}, low, ramp, high, key);
  place.replaceChildren(
      element('p', {class: 'map-title'}, said.title),
      element(
          'div', {class: 'map'}, element('div', {class: 'ticks'}, ...spans(top, 'z ↓', bottom)),
          box, element('i'), element('div', {class: 'ends'}, ...spans(left, along, right))),
      readout, bar);

  let shown = null;
  const pixel = (i) => (i % grid.columns) * grid.rows + Math.floor(i / grid.columns);
  const cellAt = (y, z) => {
    const row = Math.round((y - grid.y) / grid.dy), column = Math.round((z - grid.z) / grid.dz);
    return row >= 0 && row < grid.rows && column >= 0 && column < grid.columns ?
        row * grid.columns + column :
        null;
  };

  function drawArrows(context, scale) {
    const {along, across, most} = shown.arrows;
    const block = Math.ceil(Math.max(grid.rows, grid.columns) / mostArrows);
    const reach = scale * Math.min(grid.dy, grid.dz) * block / most;
    const shafts = new Path2D();
    for (let row = 0; row < grid.rows; row += block)
      for (let column = 0; column < grid.columns; column += block) {
        let y = 0, z = 0, count = 0;
        const lastRow = Math.min(row + block, grid.rows);
        const lastColumn = Math.min(column + block, grid.columns);
        for (let i = row; i < lastRow; ++i)
          for (let j = column; j < lastColumn; ++j, ++count) {
            const cell = i * grid.columns + j;
            if (shown.touching && !shown.touching(cell)) continue;
            y += along[cell];
            z += across[cell];
          }
        const right = reach * y / count, down = reach * z / count, length = Math.hypot(right, down);
        if (!(length > Math.max(2, 0.1 * reach * most))) continue;
        const middleX = scale * grid.dy * (row + lastRow) / 2;
        const middleY = scale * grid.dz * (column + lastColumn) / 2;
        const tipX = middleX + right / 2, tipY = middleY + down / 2;
        const head = Math.min(7, 0.45 * length) / length;
        shafts.moveTo(tipX - right, tipY - down);
        shafts.lineTo(tipX, tipY);
        shafts.moveTo(tipX - head * (right + down / 2), tipY - head * (down - right / 2));
        shafts.lineTo(tipX, tipY);
        shafts.lineTo(tipX - head * (right - down / 2), tipY - head * (down + right / 2));
      }
    context.lineJoin = context.lineCap = 'round';
    for (const [colour, thick] of [['--paper', 4.5], ['--orange', 2]]) {
      context.strokeStyle = ink(colour);
      context.lineWidth = thick;
      context.stroke(shafts);
    }
  }

  function drawOutline(context, scale) {
    const inside = (row, column) => row >= 0 && column >= 0 && row < grid.rows &&
        column < grid.columns && shown.touching(row * grid.columns + column);
    const edges = new Path2D();
    for (let row = 0; row <= grid.rows; ++row)
      for (let column = 0; column <= grid.columns; ++column) {
        const x = row * grid.dy * scale, y = column * grid.dz * scale;
        const here = inside(row, column);
        if (here !== inside(row - 1, column)) {
          edges.moveTo(x, y);
          edges.lineTo(x, y + grid.dz * scale);
        }
        if (here !== inside(row, column - 1)) {
          edges.moveTo(x, y);
          edges.lineTo(x + grid.dy * scale, y);
        }
      }
    context.strokeStyle = ink('--ink');
    context.lineWidth = 1.4;
    context.stroke(edges);
  }

  /** Values of taxels that lie in no lattice: a disc each. */
  function drawDiscs(context, scale) {
    const {y, z, values} = shown.discs;
    const colours = pixelsOf(said.palette), radius = Math.max(3, 0.4 * scale * grid.dy);
    const bytes = new Uint8Array(colours.buffer);
    for (let i = 0; i < y.length; ++i) {
      if (Number.isNaN(values[i])) continue;
      const at = 4 * Math.max(0, Math.min(255, Math.round(127.5 * (1 + values[i] / shown.most))));
      context.fillStyle = `rgb(${bytes[at]}, ${bytes[at + 1]}, ${bytes[at + 2]})`;
      context.strokeStyle = ink('--quiet');
      context.lineWidth = 0.7;
      context.beginPath();
      context.arc(
          scale * (y[i] - grid.y + grid.dy / 2), scale * (z[i] - grid.z + grid.dz / 2), radius, 0,
          7);
      context.fill();
      context.stroke();
    }
  }

  function drawTaxels(context, scale) {
    const {y, z, dead} = shown.taxels;
    const at =
        (i) => [scale * (y[i] - grid.y + grid.dy / 2), scale * (z[i] - grid.z + grid.dz / 2)];
    const dots = new Path2D(), crosses = new Path2D();
    for (let i = 0; i < y.length; ++i) {
      const [across, down] = at(i);
      if (dead.includes(i)) {
        for (const side of [-4, 4]) {
          crosses.moveTo(across - 4, down - side);
          crosses.lineTo(across + 4, down + side);
        }
      } else if (y.length <= mostDots) {
        dots.moveTo(across + 1.2, down);
        dots.arc(across, down, 1.2, 0, 7);
      }
    }
    context.fillStyle = context.strokeStyle = ink('--ink');
    context.globalAlpha = 0.4;
    context.fill(dots);
    context.globalAlpha = 0.8;
    context.lineWidth = 1.4;
    context.stroke(crosses);
    context.globalAlpha = 1;
  }

  function drawNames(context, scale) {
    context.font = 'bold 14px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineWidth = 4;
    context.strokeStyle = ink('--paper');
    context.fillStyle = ink('--ink');
    for (const {text, y, z} of shown.names) {
      const at = [scale * (y - grid.y + grid.dy / 2), scale * (z - grid.z + grid.dz / 2)];
      context.strokeText(text, ...at);
      context.fillText(text, ...at);
    }
  }

  function draw() {
    if (!shown) return;
    const context = cells.getContext('2d');
    const image = context.createImageData(grid.rows, grid.columns);
    paint(image, shown.values, shown.most, said.palette, pixel);
    context.putImageData(image, 0, 0);
    const fine = devicePixelRatio || 1, wide = box.clientWidth, high_ = box.clientHeight;
    if (above.width !== Math.round(wide * fine) || above.height !== Math.round(high_ * fine)) {
      above.width = Math.round(wide * fine);
      above.height = Math.round(high_ * fine);
    }
    const over = above.getContext('2d');
    over.setTransform(fine, 0, 0, fine, 0, 0);
    over.clearRect(0, 0, wide, high_);
    const scale = wide / width;
    if (shown.discs) drawDiscs(over, scale);
    if (shown.taxels) drawTaxels(over, scale);
    if (shown.arrows) drawArrows(over, scale);
    if (shown.touching) drawOutline(over, scale);
    if (shown.names) drawNames(over, scale);
  }

  function drawBar() {
    const {most, unit} = shown, half = said.half || said.palette === 'sizes';
    ramp.style.background = gradient(said.palette, said.half);
    low.textContent = half ? '0' : brief(-most * unit.factor);
    high.textContent = `${brief(most * unit.factor)} ${unit.label}`;
    key.textContent = shown.arrows ?
        `longest arrow: drag of ${brief(shown.arrows.most * unit.factor)} ${unit.label}` :
        '';
  }

  const map = {
    /** @param what {values, most, unit, arrows?, touching?, taxels?, discs?, names?, say(cell)} */
    show(what) {
      const bar = !shown || shown.most !== what.most;
      shown = what;
      if (bar) drawBar();
      draw();
      map.point(map.at);
    },
    at: null,
    /** Marks a place, and says what is there. */
    point(at) {
      map.at = at;
      const cell = at && cellAt(at.y, at.z);
      mark.hidden = cell === null || !at;
      if (mark.hidden) {
        readout.textContent = ' ';
        return;
      }
      const row = Math.floor(cell / grid.columns), column = cell % grid.columns;
      mark.style.left = `${100 * row / grid.rows}%`;
      mark.style.top = `${100 * column / grid.columns}%`;
      mark.style.width = `${100 / grid.rows}%`;
      mark.style.height = `${100 / grid.columns}%`;
      readout.textContent = `${where(row, column)}: ${shown.say(cell)}`;
    },
    onPoint: null,
    onPick: null,
  };
  const placeUnder = (event) => {
    const frame = box.getBoundingClientRect();
    return {
      y: grid.y - grid.dy / 2 + width * (event.clientX - frame.left) / frame.width,
      z: grid.z - grid.dz / 2 + height * (event.clientY - frame.top) / frame.height
    };
  };
  box.addEventListener('pointermove', (event) => map.onPoint?.(placeUnder(event)));
  box.addEventListener('pointerleave', () => map.onPoint?.(null));
  box.addEventListener('click', (event) => map.onPick?.(placeUnder(event)));
  new ResizeObserver(draw).observe(box);
  whenColoursChange(() => {
    if (!shown) return;
    drawBar();
    draw();
  });
  return map;
}
