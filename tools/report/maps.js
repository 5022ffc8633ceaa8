// tools/report/maps.js
// The maps of the HTML report: zoom, move, the value and the place at the cursor. All maps show the
// same part, so that they can be compared.
// in:  svg.plan in .sheet; beside it the values of its cells as JSON (libcore/report/map_sheet.cpp):
//      x, y, cell [units of the drawing], n_cols, n_rows, unit, labels of codes, values: floats, zlib,
//      base64. #sheet has the map coordinates of the drawing's zero and the metres of a unit.
'use strict';

function talusMaps() {
  const sheets = [...document.querySelectorAll('.sheet')];
  if (sheets.length === 0) return;
  const place = document.getElementById('sheet').dataset;
  const whole = sheets[0].querySelector('svg').viewBox.baseVal, width = whole.width, height = whole.height;
  const shown = {x: 0, y: 0, width};  // of the drawing

  const show = () => {
    shown.width = Math.min(width, Math.max(width / 40, shown.width));
    const h = shown.width * height / width;
    shown.x = Math.min(width - shown.width, Math.max(0, shown.x));
    shown.y = Math.min(height - h, Math.max(0, shown.y));
    for (const sheet of sheets) {
      const svg = sheet.querySelector('svg');
      svg.setAttribute('viewBox', `${shown.x} ${shown.y} ${shown.width} ${h}`);
      svg.setAttribute('font-size', 10 * shown.width / width);
      sheet.classList.toggle('near', shown.width < width);
    }
  };
  // `factor` times as near, about a point of the drawing.
  const zoom = (factor, x, y) => {
    const before = shown.width;
    shown.width = Math.min(width, Math.max(width / 40, shown.width / factor));
    shown.x = x - (x - shown.x) * shown.width / before;
    shown.y = y - (y - shown.y) * shown.width / before;
    show();
  };

  const valuesOf = async (script) => {
    const map = JSON.parse(script.textContent);
    const bytes = Uint8Array.from(atob(map.values), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    map.values = new Float32Array(await new Response(stream).arrayBuffer());
    return map;
  };
  const wordsOf = (map, x, y) => {
    const col = Math.floor((x - map.x) / map.cell), row = Math.floor((y - map.y) / map.cell);
    const isInside = col >= 0 && col < map.n_cols && row >= 0 && row < map.n_rows;
    const value = isInside ? map.values[row * map.n_cols + col] : NaN;
    if (Number.isNaN(value) || value === 0) return '\u2013';
    if (map.labels[value]) return map.labels[value];
    return Number(value.toPrecision(3)).toLocaleString(document.documentElement.lang) + (map.unit === '1' ? '' : ' ' + map.unit);
  };

  for (const sheet of sheets) {
    const svg = sheet.querySelector('svg'), script = sheet.querySelector('script');
    const bar = document.createElement('div'), out = document.createElement('output');
    bar.className = 'zoom';
    out.className = 'value';
    bar.innerHTML = '<button type="button" aria-label="{{maps.nearer}}">+</button><button type="button" aria-label="{{maps.farther}}">&minus;</button>';
    sheet.append(bar, out);
    let map = null, asked = false;
    const held = new Map();  // pointers that are down, by id: their last place on the screen
    const at = (e) => {
      const box = svg.getBoundingClientRect(), metres = shown.width / box.width;
      return {x: shown.x + (e.clientX - box.left) * metres, y: shown.y + (e.clientY - box.top) * metres, metres};
    };
    const tell = (e) => {
      const {x, y} = at(e);
      if (script && !asked && window.DecompressionStream) {
        asked = true;
        valuesOf(script).then((made) => { map = made; tell(e); });
      }
      const round = (value) => Math.round(value).toLocaleString(document.documentElement.lang);
      out.textContent = (map ? wordsOf(map, x, y) + ' {{maps.at}} ' : '') + round(Number(place.west) + x * place.metres) + ' E, ' +
          round(Number(place.north) - y * place.metres) + ' N';
    };
    const middle = () => ({x: shown.x + shown.width / 2, y: shown.y + shown.width * height / width / 2});
    bar.children[0].addEventListener('click', () => zoom(1.6, middle().x, middle().y));
    bar.children[1].addEventListener('click', () => zoom(1 / 1.6, middle().x, middle().y));
    svg.addEventListener('dblclick', (e) => zoom(e.shiftKey ? 0.5 : 2, at(e).x, at(e).y));
    svg.addEventListener('wheel', (e) => {
      if (!e.ctrlKey) return;  // the page itself scrolls
      e.preventDefault();
      zoom(Math.exp(-0.003 * e.deltaY), at(e).x, at(e).y);
    }, {passive: false});
    svg.addEventListener('pointerdown', (e) => {
      held.set(e.pointerId, {x: e.clientX, y: e.clientY});
      tell(e);
    });
    svg.addEventListener('pointermove', (e) => {
      const last = held.get(e.pointerId);
      if (last && shown.width < width) {
        if (!svg.hasPointerCapture(e.pointerId)) svg.setPointerCapture(e.pointerId);
        const other = [...held].find(([id]) => id !== e.pointerId);
        const {x, y, metres} = at(e);
        if (other) {  // two fingers
          const apart = (p) => Math.hypot(p.x - other[1].x, p.y - other[1].y);
          zoom(apart({x: e.clientX, y: e.clientY}) / Math.max(1, apart(last)), x, y);
        } else {
          shown.x -= (e.clientX - last.x) * metres;
          shown.y -= (e.clientY - last.y) * metres;
          show();
        }
        held.set(e.pointerId, {x: e.clientX, y: e.clientY});
      }
      tell(e);
    });
    for (const end of ['pointerup', 'pointercancel', 'pointerleave'])
      svg.addEventListener(end, (e) => held.delete(e.pointerId));
  }
}
