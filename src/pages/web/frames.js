// The frames of a recording, or one frame, of a line or a skin: a slider moves one mark through all
// pictures, and the pointer one place. A page has places for the views that it shows.

function showFrames(root, d) {
  const skin = !d.line;
  const {place: when, answer, trust} = d.frames;
  const find = (view) => root.querySelector(`[data-view=${view}]`);
  const all = d.tractions.map(
      (one) => ({
        ...one,
        values: unpack(one.values),
        deviations: unpack(one.deviations),
        ends: one.ends &&
            {low: unpack(one.ends.low), high: unpack(one.ends.high), label: one.ends.label},
        truth: unpack(one.truth)
      }));
  const normal = all[0];
  const readings = d.readings.map((one) => ({...one, values: unpack(one.values)}));
  const count = when.length, {rows, columns} = d.grid;
  const places = Array.from({length: rows}, (_, i) => (d.grid.y + i * d.grid.dy) * d.length.factor);
  const across =
      Array.from({length: columns}, (_, i) => (d.grid.z + i * d.grid.dz) * d.length.factor);
  const scaled = (values, factor) =>
      Array.from(values, (value) => Number.isNaN(value) ? null : value * factor);
  const unitOf = (unit) => unit.label ? ` [${unit.label}]` : '';
  const lengthLabel = (axis) => axis + unitOf(d.length);
  const stress = (value, deviation) => withUnit(value, deviation, d.stress);

  const inShort = (k) => `${when[k]}: ${answer[k]}`;

  let frame = d.frames.start, pinned = null;
  const touching = (k) => {
    const cells = d.touching?.[k];
    if (!cells) return null;
    const inside = new Uint8Array(rows * columns);
    for (const [first, length] of cells) inside.fill(1, first, first + length);
    return (cell) => inside[cell] === 1;
  };

  /** The cell that presses hardest. */
  const peak = (values) => {
    let best = 0;
    for (let i = 1; i < values.length; ++i)
      if (values[i] > values[best]) best = i;
    return best;
  };
  const cellShown = () => pinned ?? peak(normal.values.of(frame));
  const cellAt = ({y, z}) => {
    const row = Math.round((y - d.grid.y) / d.grid.dy),
          column = skin ? Math.round((z - d.grid.z) / d.grid.dz) : 0;
    return row < 0 || row >= rows || column < 0 || column >= columns ? null :
                                                                       row * columns + column;
  };
  const placeOf = (cell) => ({
    y: placeOfCell(d.grid.y, d.grid.dy, Math.floor(cell / columns)),
    z: placeOfCell(d.grid.z, d.grid.dz, cell % columns)
  });
  const inWords = (cell) => {
    const {y, z} = placeOf(cell), length = (x) => brief(x * d.length.factor);
    return `y = ${length(y)}${skin ? `, z = ${length(z)}` : ''} ${d.length.label}`.trim();
  };

  /** All that is known of a cell in the frame shown. */
  const sayCell = (cell) =>
      all.map(
             (one) => `${one.sign} ` +
                 stress(one.values.of(frame)[cell], one.deviations?.of(frame)[cell]) +
                 (one.truth ? ` (true ${stress(one.truth.of(frame)[cell])})` : ''))
          .join(', ');

  /** The channel's taxel nearest to a place. */
  const nearest = (channel, at) => {
    const away = (i) => Math.hypot(channel.y[i] - at.y, skin ? channel.z[i] - at.z : 0);
    let best = 0;
    for (let i = 1; i < channel.y.length; ++i)
      if (away(i) < away(best)) best = i;
    return best;
  };

  // ---- Contacts of the frame shown: always as many rows, so that nothing below moves.
  const contacts = find('contacts');
  const most = d.contacts ? Math.max(...d.contacts.rows.map((rows) => rows.length)) : 0;
  /** The contacts' numbers, where they press. */
  const namesOf = (k) => {
    if (most < 2) return undefined;
    const [y, z] = ['centre, y', 'centre, z'].map(
        (label) => 1 + d.contacts.columns.findIndex((one) => one.label === label));
    return d.contacts.rows[k]
        .filter((row) => y && z && row[y] && row[z])
        .map((row) => ({text: `${row[0]}`, y: row[y][0], z: row[z][0]}));
  };
  function showContacts() {
    const rows = d.contacts.rows[frame], {columns} = d.contacts;
    const cell = (label, text) => element('td', {'data-label': label}, text);
    // A column has one unit for all frames, in which some are small.
    const number = (of, {factor}) => of ? plusMinus(of[0] * factor, of[1] * factor, 1e-5) : '–';
    const texts =
        ([id, ...values]) => [`${id}`, ...columns.map(({unit}, i) => number(values[i], unit))];
    const labels = ['contact', ...columns.map(({label, unit}) => label + unitOf(unit))];
    contacts.tBodies[0].replaceChildren(...Array.from(
        {length: most},
        (_, i) => element(
            'tr', rows[i] ? {} : {style: 'visibility: hidden'},
            ...(rows[i] ? texts(rows[i]) : labels.map(() => '–'))
                .map((text, k) => cell(labels[k], text)))));
    contacts.tHead.rows[0].replaceChildren(...labels.map((label) => element('th', {}, label)));
  }

  // ---- Maps of a skin.
  const maps = [];
  function addMap(view, title, palette, what, half = false) {
    if (!find(view)) return;
    const place = element('div');
    find(view).append(place);
    const map = makeMap(
        place, what.grid ?? d.grid,
        {title, label: `Map: ${title}`, palette, half, length: d.length});
    maps.push({map, what});
    map.onPoint = (at) => {
      for (const one of maps) one.map.point(at);
    };
    map.onPick = (at) => {
      const cell = cellAt(at);
      pinned = cell === null || cell === pinned ? null : cell;
      showPlace();
    };
  }
  const arrowsOf = (which) => all.length === 3 && d.largest.drag > 0.1 * d.largest.normal ?
      (k) => all[1][which] &&
          ({along: all[1][which].of(k), across: all[2][which].of(k), most: d.largest.drag}) :
      () => undefined;
  if (skin) {
    const taxels = d.taxels;
    const found = arrowsOf('values'), exact = arrowsOf('truth');
    if (normal.truth)
      addMap(
          'tractions', 'What presses', 'signed', {
            of: (k) => ({
              values: normal.truth.of(k),
              most: d.largest.normal,
              unit: d.stress,
              taxels,
              arrows: exact(k),
              say: sayCell
            })
          },
          !d.negative);
    addMap(
        'tractions', d.title, 'signed', {
          of: (k) => ({
            values: normal.values.of(k),
            most: d.largest.normal,
            unit: d.stress,
            taxels,
            arrows: found(k),
            touching: touching(k),
            names: namesOf(k),
            say: sayCell
          })
        },
        !d.negative);
    if (normal.deviations)
      addMap(normal.truth ? 'errors' : 'tractions', 'Standard deviation of p', 'sizes', {
        of: (k) => {
          const values = normal.deviations.of(k);
          return {
            values,
            most: d.largest.deviation,
            unit: d.stress,
            taxels,
            say: (cell) => `± ${stress(values[cell])}`
          };
        }
      });
    if (normal.truth)
      addMap('errors', 'How far p is off: found minus true', 'signed', {
        of: (k) => {
          const values = normal.values.of(k).map((value, i) => value - normal.truth.of(k)[i]);
          return {
            values,
            most: d.largest.error,
            unit: d.stress,
            taxels,
            say: (cell) => `off by ${stress(values[cell])}`
          };
        }
      });
    const isDead = (_, i) => taxels.dead.includes(i);
    const crosses = {
      y: taxels.y.filter(isDead),
      z: taxels.z.filter(isDead),
      dead: taxels.dead.map((_, i) => i)
    };
    const nowhere = new Float32Array(rows * columns).fill(NaN);
    for (const channel of readings) {
      const shown = {most: channel.largest, unit: channel.unit, taxels: crosses};
      const of = channel.grid ? (k) => {
        const values = channel.values.of(k);
        return {...shown, values, say: (cell) => withUnit(values[cell], 0, channel.unit)};
      } : (k) => {
        const values = channel.values.of(k);
        const say = (cell) => withUnit(values[nearest(channel, placeOf(cell))], 0, channel.unit);
        return {...shown, values: nowhere, discs: {y: channel.y, z: channel.z, values}, say};
      };
      addMap('readings', channel.name, channel.shear ? 'drag' : 'signed', {grid: channel.grid, of});
    }
  }

  // ---- The surface of a curved skin.
  const sides = d.surface && find('sides') && makeSides(find('sides'), d, {
                  say: (cell) => `${inWords(cell)} of the surface laid flat: ${sayCell(cell)}`,
                  point: (cell) => {
                    for (const one of maps) one.map.point(cell === null ? null : placeOf(cell));
                  },
                  pick: (cell) => {
                    pinned = cell === pinned ? null : cell;
                    showPlace();
                  }
                });

  /** A curve's interval, or its band where only deviations are known. */
  const bandOf = (one, take) => one.ends ?
      {low: take(one.ends.low, d.stress.factor), high: take(one.ends.high, d.stress.factor)} :
      {band: one.deviations && take(one.deviations, 2 * d.stress.factor)};
  const bandLabel = normal.ends?.label ?? (normal.deviations ? 'two standard deviations' : '');

  // ---- Curves along the surface.
  const range = [d.low * d.stress.factor, d.high * d.stress.factor];
  const curvesAlong = (pick, xs, shown) => shown.flatMap((one) => {
    const curves = [{
      label: one.title,
      colour: one.colour,
      x: xs,
      y: scaled(pick(one.values.of(frame)), d.stress.factor),
      ...bandOf(one, (values, factor) => scaled(pick(values.of(frame)), factor))
    }];
    if (one.truth)
      curves.push({
        label: `${one.title}, true`,
        colour: one.colour,
        dashed: true,
        x: xs,
        y: scaled(pick(one.truth.of(frame)), d.stress.factor)
      });
    return curves;
  });
  const sections = [];
  function addSection(axis, xs, pick, shown) {
    const place = element('div');
    find('sections').append(place);
    const title = element('p', {class: 'map-title'});
    place.append(title);
    const chart = makeChart(place, {
      name: `Tractions along ${axis}`,
      height: 250,
      x: {label: lengthLabel(axis), tight: true},
      y: {label: `traction${unitOf(d.stress)}`, range},
      curves: curvesAlong(pick, xs, shown),
      band_label: bandLabel
    });
    sections.push({chart, title, axis, xs, pick, shown});
  }
  const alongY = (values) =>
      Array.from({length: rows}, (_, i) => values[i * columns + cellShown() % columns]);
  const alongZ = (values) => {
    const row = Math.floor(cellShown() / columns);
    return values.subarray(row * columns, (row + 1) * columns);
  };
  if (find('sections')) {
    addSection('y', places, skin ? alongY : (values) => values, all.slice(0, 2));
    if (skin) addSection('z', across, alongZ, all.length === 3 ? [all[0], all[2]] : [all[0]]);
  }

  // ---- The pad, and a line's readings.
  const pad = find('pad') && makePad(find('pad'), d, sayCell);
  const lines = [];
  if (!skin)
    for (const channel of readings) {
      const place = element('div');
      place.append(element('p', {class: 'map-title'}, channel.name));
      find('readings').append(place);
      const xs = scaled(channel.y, d.length.factor);
      const curves = () => [{
        label: channel.name,
        colour: channel.shear ? 'tangential' : 'normal',
        marks: true,
        width: 1,
        x: xs,
        y: scaled(channel.values.of(frame), channel.unit.factor)
      }];
      const everyFrame = Array.from({length: count}, (_, k) => channel.values.of(k));
      const [least, most] = rangeOf([[0], ...everyFrame]).map((x) => x * channel.unit.factor);
      const room = 0.05 * (most - least || 1);
      lines.push({
        curves,
        chart: makeChart(place, {
          name: channel.name,
          height: 220,
          x: {label: lengthLabel('y')},
          y: {label: `reading${unitOf(channel.unit)}`, range: [least - room, most + room]},
          curves: curves()
        })
      });
    }

  // ---- Over time.
  let time = null, course = null, traces = null, waiting = 0;
  const titled = (title) => {
    const place = element('div');
    place.append(element('p', {class: 'map-title'}, title));
    find('time').append(place);
    return place;
  };
  if (count > 1) {
    time = makeTimeline(d);
    time.onPick = (k) => show(k);
    for (const one of d.courses)
      time.chart(
          titled(one.title),
          {name: one.title, y: {label: one.label}, band_label: one.bands, curves: one.lines},
          inShort);
    const inLength = (values) => values.map((y) => y === null ? null : y * d.length.factor);
    for (const one of skin ? all.slice(0, 1) : all) {
      const largestAlong = (k, row) => {
        const values = one.values.of(k);
        let most = values[row * columns];
        for (let i = 1; i < columns; ++i) most = Math.max(most, values[row * columns + i]);
        return most;
      };
      const half = d.grid.dy * d.length.factor / 2, low = places[0] - half,
            high = places[rows - 1] + half;
      const most = one.colour === 'normal' ? d.largest.normal : d.largest.drag;
      if (!(most > 0)) continue;
      time.chart(
          titled(
              skin ? 'Pressure, y over time: the largest along z' :
                     `${one.title[0].toUpperCase()}${one.title.slice(1)}, y over time`),
          {
            name: `Heat map of ${one.title} over time`,
            y: {label: lengthLabel('y'), range: [low, high]},
            band_label: one.colour === 'normal' && d.centre ? d.centre.bands : '',
            curves: one.colour === 'normal' && d.centre ? [{
              label: 'centre of pressure',
              colour: 'ink',
              width: 1.5,
              y: inLength(d.centre.y),
              ...(d.centre.bands && {low: inLength(d.centre.low), high: inLength(d.centre.high)})
            }] :
                                                          []
          },
          inShort,
          heatMap(
              time, rows, largestAlong, most, one.colour === 'normal' ? 'signed' : 'drag', low,
              high));
    }
    course = {title: titled(''), chart: null};
    if (readings.length) traces = {title: titled(''), chart: null};
    time.strip(titled(`Which frames to trust, over ${time.label}: red ones are not`));
  }

  /** A chart below its title, made once; later its curves alone are changed. */
  function drawOrChange(part, spec, say) {
    if (part.chart)
      part.chart.setCurves(spec.curves);
    else
      part.chart = time.chart(part.title, spec, say);
  }

  /** What belongs to the cell that is chosen, or else to the one that presses hardest. */
  function showPlace() {
    const cell = cellShown();
    for (const one of sections) {
      const at = placeOf(cell), other = one.axis === 'y' ? at.z : at.y;
      one.title.textContent = !skin ? 'Tractions along the array' :
                                      `Along ${one.axis}, at ${one.axis === 'y' ? 'z' : 'y'} = ${
                                          brief(other * d.length.factor)} ${d.length.label}` +
              (pinned === null ? ', through the peak' : '');
      one.chart.update(curvesAlong(one.pick, one.xs, one.shown));
    }
    clearTimeout(waiting);
    if (!time || (course.chart && course.cell === cell)) return;
    course.chart ? waiting = setTimeout(() => showCourse(cell), 100) : showCourse(cell);
  }

  /** The chosen cell over time; not at every step of the slider, but where it stays. */
  function showCourse(cell) {
    course.cell = cell;
    course.title.firstChild.textContent =
        `Tractions at ${inWords(cell)}` + (pinned === null ? ', where it presses hardest' : '');
    const over = (packed, factor) => Array.from({length: count}, (_, k) => {
      const value = packed.of(k)[cell] * factor;
      return Number.isNaN(value) ? null : value;
    });
    const curves = all.map((one, i) => ({
                             label: one.title,
                             colour: i === 2 ? 'ink' : one.colour,
                             dashed: i === 2,
                             y: over(one.values, d.stress.factor),
                             ...bandOf(one, over)
                           }));
    const sayPlace = (k) => `${when[k]}: ` +
        all.map(
               (one) => `${one.sign} ` +
                   stress(one.values.of(k)[cellShown()], one.deviations?.of(k)[cellShown()]))
            .join(', ');
    drawOrChange(
        course, {
          name: 'Tractions of one cell over time',
          y: {label: `traction${unitOf(d.stress)}`},
          curves,
          band_label: bandLabel
        },
        sayPlace);
    if (traces) showTraces(placeOf(cell));
  }

  /** The readings of the taxel that is nearest to a place. */
  function showTraces(at) {
    const same = readings.filter((one) => one.unit.label === readings[0].unit.label);
    traces.at = at;
    const first = nearest(readings[0], at);
    traces.title.firstChild.textContent =
        `Readings of the taxel nearest to it, at ` +
        `y = ${brief(readings[0].y[first] * d.length.factor)}${
            skin ? `, z = ${brief(readings[0].z[first] * d.length.factor)}` :
                   ''} ${d.length.label}`;
    const curves = same.map((one, i) => {
      const taxel = nearest(one, at);
      return {
        label: one.name,
        colour: i + 1,
        width: 1.5,
        y: scaled(Array.from({length: count}, (_, k) => one.values.of(k)[taxel]), one.unit.factor)
      };
    });
    const say = (k) => `${when[k]}: ` +
        same.map(
                (one) => `${one.name} ${
                    withUnit(one.values.of(k)[nearest(one, traces.at)], 0, one.unit)}`)
            .join(', ');
    drawOrChange(
        traces, {
          name: 'Readings of one taxel over time',
          y: {label: `reading${unitOf(same[0].unit)}`},
          curves
        },
        say);
  }

  const slider = find('slider');
  function sayFrame() {
    find('where').textContent = when[frame];
    find('answer').textContent = answer[frame];
    find('trust').textContent = trust[frame];
    find('trust').hidden = !trust[frame];
    slider.value = frame;
    slider.setAttribute('aria-valuetext', inShort(frame));
  }
  function show(k) {
    frame = k;
    for (const {map, what} of maps) map.show(what.of(k));
    sides?.show(k, normal.values.of(k), touching(k));
    pad?.show(all.map((one) => one.values.of(k)));
    for (const one of lines) one.chart.update(one.curves());
    showPlace();
    time?.mark(k);
    if (slider) sayFrame();
    if (contacts) showContacts();
  }
  slider?.addEventListener('input', () => show(Number(slider.value)));
  if (slider) slider.hidden = count < 2;
  show(frame);
}
