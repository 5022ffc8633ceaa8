// tools/report/profile.js
// One trajectory of the HTML report: the record along its path, as charts and as a table.
// in:  talusProfiles(element, scene); scene.paths as talus-report writes it
//      (docs/reference/formats.md#viewer): columns of values, points of one block after the other
// A block is chosen in the list, on the map of the run, or in the 3-D view.
'use strict';

function talusProfiles(root, scene, listeners = []) {
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const counts = ({bytes: size, all}) => [...(size === 2 ? new Uint16Array(bytes(all)) : new Uint32Array(bytes(all)))];
  const {columns, blocks: packedBlocks, n_points: packedNumbers} = scene.paths;
  const blocks = counts(packedBlocks), numbers = counts(packedNumbers);
  const first = numbers.map(((sum) => (n) => (sum += n) - n)(0));
  for (const column of columns) {
    const [low, step] = column.packing;
    column.all = Float64Array.from(new Uint16Array(bytes(column.values)), (word) => word === 65535 ? NaN : low + step * word);
    if (column.name === 'z_m') column.all = column.all.map((z) => z + (scene.terrain.z_origin_m || 0));
  }
  const lang = document.documentElement.lang;
  const number = (value) => Number(value.toPrecision(3)).toLocaleString(lang);
  const escaped = (text) => text.replace(/[&<>]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;'})[c]);

  // Values of a block by the names of their columns.
  const pathOf = (block) => {
    const at = blocks.indexOf(block);
    if (at < 0) return null;
    return Object.fromEntries(columns.map((c) => [c.name, [...c.all.slice(first[at], first[at] + numbers[at])]]));
  };

  const ticks = (low, high) => {
    const rough = (high - low) / 5 || 1, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((f) => f * power >= rough), out = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; ++k) out.push(k * step);
    return out;
  };
  // Lines [{y, colour}] over x, with gaps where y is unknown.
  const chart = (title, xTitle, x, lines) => {
    const w = 640, h = 240, left = 62, right = 14, top = 26, bottom = 38;
    const known = lines.flatMap((line) => line.y).filter((y) => !Number.isNaN(y));
    const high = Math.max(...known), low = Math.min(...known, title.startsWith(columns.at(-1).title) ? high : 0);
    const px = (v) => left + (v - x[0]) / (x.at(-1) - x[0] || 1) * (w - left - right);
    const py = (v) => h - bottom - (v - low) / (high - low || 1) * (h - top - bottom);
    let out = `<svg class="chart" viewBox="0 0 ${w} ${h}" role="img"><text class="title" x="${left}" y="16">${escaped(title)}</text>`;
    for (const v of ticks(low, high))
      out += `<path class="grid" d="M${left} ${py(v)}H${w - right}"/><text x="${left - 6}" y="${py(v) + 4}" text-anchor="end">${number(v)}</text>`;
    for (const v of ticks(x[0], x.at(-1)))
      out += `<path class="grid" d="M${px(v)} ${top}V${h - bottom}"/><text x="${px(v)}" y="${h - bottom + 15}" text-anchor="middle">${number(v)}</text>`;
    for (const {y, colour} of lines) {
      let d = '', isOpen = false;
      y.forEach((v, i) => {
        if (!Number.isNaN(v)) d += (isOpen ? 'L' : 'M') + px(x[i]).toFixed(1) + ' ' + py(v).toFixed(1);
        isOpen = !Number.isNaN(v);
      });
      out += `<path d="${d}" fill="none" stroke="${colour}" stroke-width="1.6"/>`;
    }
    return `<figure>${out}<text x="${(left + w - right) / 2}" y="${h - 6}" text-anchor="middle">${escaped(xTitle)}</text></svg></figure>`;
  };

  root.innerHTML = `<p><label>{{profile.block}} <select></select></label> <a download>{{profile.table}}</a></p><div class="charts"></div>`;
  const list = root.querySelector('select'), link = root.querySelector('a'), charts = root.querySelector('.charts');
  const titleOf = (column) => column.title + ' [' + column.unit + ']';
  const column = (name) => columns.find((c) => c.name === name);
  for (const block of blocks) {
    const path = pathOf(block);
    list.add(new Option(`${block}: ${number(path.distance_m.at(-1))} m, ${number(Math.max(...path.energy_kj))} kJ`, block));
  }
  // Shapes of a block on the map of the run: its tooltip begins with the number.
  const shapes = [...document.querySelectorAll('#maps figure svg.plan')].slice(0, 1).flatMap((plan) => [...plan.querySelectorAll('title')])
      .map((title) => ({shape: title.parentNode, of: Number(title.textContent.match(/\d+/)?.[0] ?? -1)}));
  const show = (block) => {
    const path = pathOf(block);
    if (!path) return;
    list.value = block;
    const x = path.distance_m, xTitle = titleOf(column('distance_m'));
    const ground = path.z_m.map((z, i) => z - path.height_m[i]);
    charts.innerHTML = chart(titleOf(column('z_m')), xTitle, x, [{y: ground, colour: '#8a6a4a'}, {y: path.z_m, colour: '#b3201f'}]) +
        columns.filter((c) => !['time_s', 'distance_m', 'z_m'].includes(c.name))
            .map((c) => chart(titleOf(c), xTitle, x, [{y: path[c.name], colour: '#1f5fa8'}])).join('');
    const rows = x.map((_, i) => columns.map((c) => Number.isNaN(path[c.name][i]) ? '' : Number(path[c.name][i].toPrecision(6))).join(','));
    URL.revokeObjectURL(link.href);
    link.href = URL.createObjectURL(new Blob([[columns.map((c) => c.name).join(','), ...rows].join('\n') + '\n'], {type: 'text/csv'}));
    link.download = `block_${block}.csv`;
    for (const {shape, of} of shapes) shape.classList.toggle('chosen', of === block);
  };
  const choose = (block) => {
    show(block);
    for (const tell of listeners) tell(block);
  };
  list.addEventListener('change', () => choose(Number(list.value)));
  for (const {shape, of} of shapes) shape.addEventListener('click', () => choose(of));
  if (blocks.length > 0) show(blocks[0]);
  return {show, listeners, pathOf};
}
