// tools/report/viewer.js
// The 3-D viewer of the HTML report: terrain, blocks and fences over time, in plain WebGL2.
// in:  talusViewer(element, scene); scene as talus-report writes it (docs/reference/formats.md#viewer):
//      terrain, blocks, frames, fences, objects, trails, contour_m; arrays are base64, little-endian;
//      the ground and the cells of the page's maps are laid over the terrain; onPick(block)
// The poses of all frames lie in one texture; the vertex shader takes two frames and interpolates,
// so that a frame costs one draw call however many blocks there are. z is up.
'use strict';

function talusViewer(root, scene, onPick = () => {}) {
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const floats = (text) => new Float32Array(bytes(text));
  const words = (text) => new Uint16Array(bytes(text));
  const counts = ({bytes: size, all}) => size === 2 ? words(all) : new Uint32Array(bytes(all));

  // --- elements -----------------------------------------------------------------------------------
  root.innerHTML = `
    <canvas tabindex="0" aria-label="{{viewer.canvas}}"></canvas>
    <svg class="viewer-north" viewBox="-12 -14 24 28" aria-hidden="true"><path d="M0 -12L5 6L0 2L-5 6Z"/></svg>
    <div class="viewer-bar">
      <button type="button" class="viewer-play" aria-label="{{viewer.play}}">&#9654;</button>
      <input type="range" class="viewer-time" min="0" max="1" step="any" value="0" aria-label="{{viewer.time}}">
      <output class="viewer-clock"></output>
      <label>{{viewer.pace}} <select class="viewer-pace"><option value="0.25">&frac14;</option><option value="1" selected>1</option>
        <option value="4">4</option><option value="16">16</option></select></label>
      <label><input type="checkbox" class="viewer-fences" checked> {{viewer.fences}}</label>
      <label class="viewer-objects-label"><input type="checkbox" class="viewer-objects" checked> {{viewer.objects}}</label>
      <label class="viewer-trails-label"><input type="checkbox" class="viewer-trails"> <span>{{viewer.trails}}</span></label>
      <label>{{viewer.ground}} <select class="viewer-ground"><option value="">{{viewer.hillshade}}</option></select></label>
    </div>
    <div class="viewer-legend"><span>0</span><i></i><span class="viewer-top"></span></div>
    <div class="viewer-block" aria-live="polite">{{viewer.click}}</div>`;
  const find = (name) => root.querySelector(name);
  const canvas = find('canvas');
  const gl = canvas.getContext('webgl2', {alpha: false, antialias: true, preserveDrawingBuffer: true});
  if (!gl) {
    root.innerHTML = '<p class="viewer-none">{{viewer.no_webgl}} ' +
        '{{viewer.elsewhere}}</p>';
    return null;
  }

  // --- data ---------------------------------------------------------------------------------------
  const times = scene.frames.time_s;
  const nBlocks = scene.blocks.n, nFrames = times.length;
  // x y z speed, qx qy qz qw: a frame, a block. The words hold all blocks once, then those that move.
  const unpackedPose = () => {
    const packed = words(scene.frames.pose), moved = counts(scene.frames.moved);
    const number = scene.frames.packing, size = 8 * nBlocks;
    const all = new Float32Array(size * nFrames);
    const put = (at, from) => {
      for (let k = 0; k < 8; ++k) {
        const [low, step] = number[Math.min(k, 4)];
        all[at + k] = low + step * packed[from + k];
      }
    };
    for (let b = 0; b < nBlocks; ++b) put(8 * b, 8 * b);
    for (let f = 1, from = size; f < nFrames; ++f) {
      all.copyWithin(size * f, size * (f - 1), size * f);
      for (let i = 0; i < moved.length; ++i, from += 8) put(size * f + 8 * moved[i], from);
    }
    return all;
  };
  const pose = unpackedPose();
  let topSpeed = 1e-6;
  for (let i = 3; i < pose.length; i += 8) topSpeed = Math.max(topSpeed, pose[i]);
  find('.viewer-top').textContent = topSpeed.toFixed(topSpeed < 10 ? 1 : 0) + ' m/s';

  const program = (vertex, fragment) => {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, '#version 300 es\nprecision highp float;precision highp int;precision highp sampler2D;\n' + source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++i) {
      const name = gl.getActiveUniform(made, i).name;
      uniforms[name] = gl.getUniformLocation(made, name);
    }
    return {made, uniforms};
  };

  // Surfaces are lit by the normal of the drawn triangle, so that no normals need to be stored.
  const light = `vec3 lit(vec3 colour, vec3 p) {
      vec3 n = normalize(cross(dFdx(p), dFdy(p)));  // towards the eye
      return colour * (0.35 + 0.65 * max(dot(n, normalize(vec3(-0.5, 0.5, 0.8))), 0.0));
    }`;
  const ground = program(
      `in vec3 position; uniform mat4 view; out vec3 p;
       void main() { p = position; gl_Position = view * vec4(position, 1.0); }`,
      `in vec3 p; out vec4 colour; uniform vec4 tint, drapeAt; uniform float interval, zero; uniform sampler2D drape;${light}
       void main() {
         vec2 place = vec2(p.x - drapeAt.x, drapeAt.y - p.y) * drapeAt.zw;  // west, north, 1 / width, 1 / height
         vec4 seen = texture(drape, place);
         vec3 plain = lit(tint.rgb, p);
         bool isOver = all(greaterThan(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)));
         colour = vec4(isOver ? mix(plain, seen.rgb, seen.a) : plain, tint.a);
         if (interval <= 0.0) return;
         float level = (p.z + zero) / interval, from = abs(fract(level + 0.5) - 0.5), pixel = fwidth(level);
         bool five = mod(round(level), 5.0) == 0.0;
         float line = (1.0 - smoothstep(0.5, 1.5, from / max(pixel, 1e-6))) * (1.0 - smoothstep(0.2, 0.6, pixel));
         colour.rgb = mix(colour.rgb, vec3(0.37, 0.24, 0.12), line * (five ? 0.75 : 0.35));
       }`);
  const lines = program(
      `in vec3 position; uniform mat4 view; void main() { gl_Position = view * vec4(position, 1.0); }`,
      `out vec4 colour; uniform vec4 tint; void main() { colour = tint; }`);
  const rock = program(
      `in vec3 position; in uint block; uniform mat4 view; uniform sampler2D poses; uniform int width, count, frame;
       uniform float share; out vec3 p; flat out uint id; out float speed;
       vec4 texel(int f, int part) {
         int i = 2 * (f * count + int(block)) + part;
         return texelFetch(poses, ivec2(i % width, i / width), 0);
       }
       void main() {
         vec4 a = texel(frame, 0), b = texel(frame + 1, 0), qa = texel(frame, 1), qb = texel(frame + 1, 1);
         vec4 q = normalize(mix(qa, dot(qa, qb) < 0.0 ? -qb : qb, share));
         vec3 x = position + 2.0 * cross(q.xyz, cross(q.xyz, position) + q.w * position);
         p = x + mix(a.xyz, b.xyz, share);
         speed = mix(a.w, b.w, share);
         id = block;
         gl_Position = view * vec4(p, 1.0);
       }`,
      `in vec3 p; flat in uint id; in float speed; out vec4 colour; uniform float top; uniform int picking, chosen;${light}
       vec3 ramp(float s) {
         return s < 0.5 ? mix(vec3(0.20, 0.42, 0.76), vec3(0.98, 0.84, 0.35), 2.0 * s)
                        : mix(vec3(0.98, 0.84, 0.35), vec3(0.80, 0.12, 0.14), 2.0 * s - 1.0);
       }
       void main() {
         if (picking == 1) {
           uint i = id + 1u;
           colour = vec4(float(i & 255u), float((i >> 8) & 255u), float((i >> 16) & 255u), 255.0) / 255.0;
           return;
         }
         vec3 base = int(id) == chosen ? vec3(0.95, 0.25, 0.85) : ramp(clamp(speed / top, 0.0, 1.0));
         colour = vec4(lit(base, p), 1.0);
       }`);

  // A vertex array with one buffer an attribute and, for the terrain, indices.
  const mesh = (shader, attributes, indices) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [name, data, size] of attributes) {
      const place = gl.getAttribLocation(shader.made, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      if (data instanceof Uint32Array) gl.vertexAttribIPointer(place, size, gl.UNSIGNED_INT, 0, 0);
      else gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }
    if (indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    }
    return {array, n: indices ? indices.length : attributes[0][1].length / 3, indexed: Boolean(indices)};
  };

  const terrainMesh = () => {
    const t = scene.terrain, [low, step] = t.z_m;
    const z = Float32Array.from(words(t.z), (word) => word === 65535 ? NaN : low + step * word);
    const points = new Float32Array(3 * z.length), triangles = [];
    for (let r = 0, i = 0; r < t.n_rows; ++r)
      for (let c = 0; c < t.n_cols; ++c, ++i)
        points.set([t.x0_m + c * t.cell_size_m, t.y0_m - r * t.cell_size_m, Number.isNaN(z[i]) ? 0 : z[i]], 3 * i);
    const add = (...corners) => { if (corners.every((i) => !Number.isNaN(z[i]))) triangles.push(...corners); };
    for (let r = 0; r + 1 < t.n_rows; ++r)
      for (let c = 0; c + 1 < t.n_cols; ++c) {
        const nw = r * t.n_cols + c, sw = nw + t.n_cols;
        add(nw, sw, sw + 1);
        add(nw, sw + 1, nw + 1);
      }
    return mesh(ground, [['position', points, 3]], new Uint32Array(triangles));
  };

  // Lines [[x, y, z]] as walls of their heights.
  const wallMesh = (walls) => {
    const corners = [];
    for (const {line, height} of walls)
      for (let i = 0; i + 1 < line.length; ++i) {
        const a = line[i], b = line[i + 1];
        const up = (p) => [p[0], p[1], p[2] + height];
        corners.push(...a, ...b, ...up(b), ...a, ...up(b), ...up(a));
      }
    return mesh(lines, [['position', new Float32Array(corners), 3]]);
  };

  // The ground of the maps, and the cells of one of them, as a texture over the terrain.
  const whole = document.querySelector('svg.plan')?.viewBox.baseVal, size = whole && [whole.width, whole.height];
  const draped = (cells) => {
    const made = {texture: gl.createTexture(), at: [0, 0, 0, 0]}, picture = new Image();
    gl.bindTexture(gl.TEXTURE_2D, made.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (!size || !scene.sheet) return made;
    const metres = Number(document.getElementById('sheet').dataset.metres || 1), [w, h] = size;
    picture.onload = () => {
      gl.bindTexture(gl.TEXTURE_2D, made.texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, picture);
      for (const [name, to] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
        gl.texParameteri(gl.TEXTURE_2D, name, to);
      made.at = [scene.sheet.west_m, scene.sheet.north_m, 1 / (metres * w), 1 / (metres * h)];
      ask();
    };
    picture.src = URL.createObjectURL(new Blob([`<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
      viewBox="0 0 ${w} ${h}" width="2048" height="${Math.round(2048 * h / w)}">${document.getElementById('map-ground').outerHTML}
      ${cells ? `<g opacity="0.75">${cells.outerHTML}</g>` : ''}</svg>`], {type: 'image/svg+xml'}));
    return made;
  };

  // Faces as fans of triangles in body axes; beside each corner the block that it belongs to.
  const blockMesh = () => {
    const {blocks} = scene, [low, step] = blocks.vertex_m;
    const vertices = words(blocks.vertices), corners = counts(blocks.corners);
    const nVertices = counts(blocks.n_vertices), nFaces = counts(blocks.n_faces), sizes = counts(blocks.face_sizes);
    const points = [], owners = [];
    for (let b = 0, f = 0, c = 0, first = 0; b < nBlocks; first += nVertices[b], ++b)
      for (const last = f + nFaces[b]; f < last; c += sizes[f], ++f)
        for (let k = 1; k + 1 < sizes[f]; ++k)
          for (const corner of [c, c + k, c + k + 1]) {
            for (let axis = 0; axis < 3; ++axis) points.push(low + step * vertices[3 * (first + corners[corner]) + axis]);
            owners.push(b);
          }
    return mesh(rock, [['position', new Float32Array(points), 3], ['block', new Uint32Array(owners), 1]]);
  };

  // All trails as pairs of points.
  const trailMesh = () => {
    const points = floats(scene.trails.position_m), begin = new Uint32Array(bytes(scene.trails.begin)), pairs = [];
    for (let t = 0; t < scene.trails.n; ++t)
      for (let i = begin[t]; i + 1 < begin[t + 1]; ++i) pairs.push(i, i + 1);
    return mesh(lines, [['position', points, 3]], new Uint32Array(pairs));
  };

  const terrain = terrainMesh();
  const trails = trailMesh();
  if (trails.n === 0) find('.viewer-trails-label').remove();
  else if (scene.trails.n < scene.trails.n_all)
    find('.viewer-trails-label span').textContent = `{{viewer.trails}} (${scene.trails.n} {{viewer.of}} ${scene.trails.n_all})`;
  const fences = wallMesh(scene.fences.map((fence) => ({line: fence.points_m, height: fence.height_m})));
  const objects = wallMesh(scene.objects.flatMap((object) => object.lines_m.map((line) => ({line, height: 2.5}))));
  if (objects.n === 0) find('.viewer-objects-label').remove();
  const blocks = blockMesh();

  const width = 2048;
  const texture = gl.createTexture();
  {
    const height = Math.ceil(pose.length / 4 / width);
    const padded = new Float32Array(4 * width * height);
    padded.set(pose);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, padded);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  // --- camera: turns about a point --------------------------------------------------------------
  const camera = {azimuth: -2.2, height: 0.6, distance: 1, target: [0, 0, 0]};
  {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < pose.length; i += 8)
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k], pose[i + k]);
        high[k] = Math.max(high[k], pose[i + k]);
      }
    camera.target = low.map((v, k) => (v + high[k]) / 2);
    camera.distance = 1.3 * Math.max(20, Math.hypot(...high.map((v, k) => v - low[k])));
    // Look from the side that the mass moves to.
    const last = 8 * nBlocks * (nFrames - 1), way = [0, 0];
    for (let b = 0; b < nBlocks; ++b)
      for (let k = 0; k < 2; ++k) way[k] += pose[last + 8 * b + k] - pose[8 * b + k];
    if (Math.hypot(...way) > 0) camera.azimuth = Math.atan2(way[1], way[0]) + 0.7;
  }

  const viewMatrix = () => {
    const {azimuth, height, distance, target} = camera;
    const back = [Math.cos(azimuth) * Math.cos(height), Math.sin(azimuth) * Math.cos(height), Math.sin(height)];
    const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
    const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]];
    const eye = target.map((v, k) => v + distance * back[k]);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const focal = 1 / Math.tan(0.4), aspect = canvas.width / canvas.height;
    const near = distance / 100, far = distance * 20;
    const rows = [right, up, back].map((axis) => [...axis, -dot(axis, eye)]);
    const matrix = new Float32Array(16);
    for (let c = 0; c < 4; ++c) {
      matrix[4 * c] = focal / aspect * rows[0][c];
      matrix[4 * c + 1] = focal * rows[1][c];
      matrix[4 * c + 2] = (far + near) / (near - far) * rows[2][c] + (c === 3 ? 2 * far * near / (near - far) : 0);
      matrix[4 * c + 3] = -rows[2][c];
    }
    return {matrix, right, up, back};
  };

  // --- drawing ------------------------------------------------------------------------------------
  let now = times[0], playing = false, chosen = -1, asked = false, before = 0;

  // The frame before `now`, and how far it is to the next.
  const moment = () => {
    let low = 0, high = nFrames - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= now) low = middle; else high = middle;
    }
    const frame = Math.max(0, Math.min(low, nFrames - 2));
    const span = nFrames > 1 ? times[frame + 1] - times[frame] : 1;
    return {frame, share: nFrames > 1 ? Math.min(1, Math.max(0, (now - times[frame]) / span)) : 0};
  };

  const drawMesh = (made, kind = gl.TRIANGLES) => {
    if (made.n === 0) return;
    gl.bindVertexArray(made.array);
    if (made.indexed) gl.drawElements(kind, made.n, gl.UNSIGNED_INT, 0);
    else gl.drawArrays(kind, 0, made.n);
  };

  const drawBlocks = (matrix, picking) => {
    const {frame, share} = moment();
    gl.useProgram(rock.made);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniformMatrix4fv(rock.uniforms.view, false, matrix);
    gl.uniform1i(rock.uniforms.width, width);
    gl.uniform1i(rock.uniforms.count, nBlocks);
    gl.uniform1i(rock.uniforms.frame, nFrames > 1 ? frame : 0);
    gl.uniform1f(rock.uniforms.share, share);
    gl.uniform1f(rock.uniforms.top, topSpeed);
    gl.uniform1i(rock.uniforms.picking, picking ? 1 : 0);
    gl.uniform1i(rock.uniforms.chosen, chosen);
    drawMesh(blocks);
  };

  const drawGround = (matrix) => {
    gl.useProgram(ground.made);
    gl.uniformMatrix4fv(ground.uniforms.view, false, matrix);
    gl.uniform4fv(ground.uniforms.tint, [0.86, 0.84, 0.78, 1]);
    gl.uniform1f(ground.uniforms.interval, scene.contour_m);
    gl.uniform1f(ground.uniforms.zero, zero);
    gl.bindTexture(gl.TEXTURE_2D, cover.texture);
    gl.uniform4fv(ground.uniforms.drapeAt, cover.at);
    drawMesh(terrain);
  };
  // Heights of the drawing begin at the lowest node: the height above a thick line.
  const zero = scene.contour_m > 0 ? scene.terrain.z_origin_m % (5 * scene.contour_m) : 0;

  const drawLines = (made, matrix, tint, kind) => {
    gl.useProgram(lines.made);
    gl.uniformMatrix4fv(lines.uniforms.view, false, matrix);
    gl.uniform4fv(lines.uniforms.tint, tint);
    drawMesh(made, kind);
  };

  const draw = () => {
    asked = false;
    const scale = window.devicePixelRatio || 1;
    const w = Math.max(1, Math.round(canvas.clientWidth * scale)), h = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0.93, 0.95, 0.97, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const {matrix} = viewMatrix();
    drawGround(matrix);
    drawBlocks(matrix, false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (find('.viewer-trails')?.checked) drawLines(trails, matrix, [0.45, 0.08, 0.1, 0.5], gl.LINES);
    if (find('.viewer-objects')?.checked) drawLines(objects, matrix, [0.43, 0.16, 0.63, 0.8], gl.TRIANGLES);
    if (find('.viewer-fences').checked) drawLines(fences, matrix, [0.05, 0.48, 0.2, 0.85], gl.TRIANGLES);
    gl.disable(gl.BLEND);
    const turn = Math.atan2(Math.cos(camera.azimuth), -Math.sin(camera.height) * Math.sin(camera.azimuth));
    find('.viewer-north').style.transform = `rotate(${turn}rad)`;
    showNumbers();
  };

  const showNumbers = () => {
    find('.viewer-clock').textContent = now.toFixed(2) + ' s';
    find('.viewer-time').value = String((now - times[0]) / Math.max(1e-9, times[nFrames - 1] - times[0]));
    if (chosen < 0) return;
    const {frame, share} = moment();
    const value = (k) => {
      const at = (f) => pose[8 * (Math.min(f, nFrames - 1) * nBlocks + chosen) + k];
      return at(frame) + share * (at(frame + 1) - at(frame));
    };
    const mass = scene.blocks.mass_kg[chosen], speed = value(3);
    find('.viewer-block').textContent = `{{viewer.block}} ${chosen}: ${speed.toFixed(2)} m/s, ` +
        `${(0.0005 * mass * speed * speed).toPrecision(4)} kJ ({{viewer.translation}}), ${(mass / 1000).toPrecision(4)} t, ` +
        `{{viewer.elevation}} ${(value(2) + (scene.terrain.z_origin_m || 0)).toFixed(1)} m`;
  };

  const ask = () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(tick);
  };
  const tick = (clock) => {
    if (playing) {
      now += Math.min(0.1, Math.max(0, clock - before) / 1000) * Number(find('.viewer-pace').value);
      if (now >= times[nFrames - 1]) {
        now = times[nFrames - 1];
        setPlaying(false);
      }
    }
    before = clock;
    draw();
    if (playing) ask();
  };
  const setPlaying = (on) => {
    playing = on;
    if (on && now >= times[nFrames - 1]) now = times[0];
    before = performance.now();
    find('.viewer-play').innerHTML = on ? '&#10073;&#10073;' : '&#9654;';
    find('.viewer-play').setAttribute('aria-label', on ? '{{viewer.pause}}' : '{{viewer.play}}');
    ask();
  };

  // Which block is under a point of the canvas: its number is drawn in place of its colour.
  const pick = (x, y) => {
    const {matrix} = viewMatrix();
    gl.clearColor(0, 0, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    drawBlocks(matrix, true);
    const pixel = new Uint8Array(4), scale = canvas.width / canvas.clientWidth;
    gl.readPixels(Math.round(x * scale), Math.round(canvas.height - y * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    chosen = pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
    if (chosen < 0) find('.viewer-block').textContent = '{{viewer.click}}';
    else onPick(chosen);
    ask();
  };

  // --- hands --------------------------------------------------------------------------------------
  let held = null;
  const fingers = new Map();  // that are down, by id: their last place
  // Of two fingers: how far apart they are, and their middle.
  const pair = () => {
    const [a, b] = [...fingers.values()];
    return {apart: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2};
  };
  const moveBy = (dx, dy) => {
    const {right, up} = viewMatrix(), step = camera.distance / canvas.clientHeight;
    camera.target = camera.target.map((v, k) => v - step * dx * right[k] + step * dy * up[k]);
  };
  canvas.addEventListener('pointerdown', (e) => {
    fingers.set(e.pointerId, {x: e.offsetX, y: e.offsetY});
    held = {x: e.offsetX, y: e.offsetY, moved: false, shift: e.button === 2 || e.shiftKey};
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener('pointermove', (e) => {
    if (!held) return;
    if (fingers.size === 2 && fingers.has(e.pointerId)) {
      const last = pair();
      fingers.set(e.pointerId, {x: e.offsetX, y: e.offsetY});
      const next = pair();
      camera.distance *= last.apart / next.apart;
      moveBy(next.x - last.x, next.y - last.y);
      Object.assign(held, {x: e.offsetX, y: e.offsetY, moved: true});
      ask();
      return;
    }
    const dx = e.offsetX - held.x, dy = e.offsetY - held.y;
    if (Math.hypot(dx, dy) < 3 && !held.moved) return;
    Object.assign(held, {x: e.offsetX, y: e.offsetY, moved: true});
    if (held.shift) {
      moveBy(dx, dy);
    } else {
      camera.azimuth -= 0.006 * dx;
      camera.height = Math.min(1.55, Math.max(-0.2, camera.height + 0.006 * dy));
    }
    ask();
  });
  // The finger that stays continues from its place.
  const letGo = (e) => {
    fingers.delete(e.pointerId);
    const [rest] = [...fingers.values()];
    held = rest ? {...rest, moved: true, shift: false} : null;
  };
  canvas.addEventListener('pointerup', (e) => {
    if (held && !held.moved) pick(e.offsetX, e.offsetY);
    letGo(e);
  });
  canvas.addEventListener('pointercancel', (e) => letGo(e));
  canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    camera.distance *= Math.exp(0.001 * e.deltaY);
    ask();
  }, {passive: false});
  canvas.addEventListener('keydown', (e) => {
    const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]}[e.key];
    if (turn) {
      camera.azimuth += turn[0];
      camera.height = Math.min(1.55, Math.max(-0.2, camera.height + turn[1]));
    } else if (e.key === '+' || e.key === '-') camera.distance *= e.key === '+' ? 0.9 : 1.1;
    else if (e.key === ' ') setPlaying(!playing);
    else return;
    e.preventDefault();
    ask();
  });
  find('.viewer-play').addEventListener('click', () => setPlaying(!playing));
  find('.viewer-time').addEventListener('input', (e) => {
    now = times[0] + Number(e.target.value) * (times[nFrames - 1] - times[0]);
    ask();
  });
  find('.viewer-fences').addEventListener('change', ask);
  find('.viewer-trails')?.addEventListener('change', ask);
  find('.viewer-objects')?.addEventListener('change', ask);

  // Layer over the ground.
  let cover = draped(null);
  const maps = [...document.querySelectorAll('svg.plan[aria-label]')].filter((svg) => svg.querySelector('.cells'));
  maps.forEach((svg, i) => find('.viewer-ground').add(new Option(svg.getAttribute('aria-label'), i)));
  find('.viewer-ground').addEventListener('change', (e) => {
    gl.deleteTexture(cover.texture);
    cover = draped(e.target.value === '' ? null : maps[Number(e.target.value)].querySelector('.cells'));
    ask();
  });
  new ResizeObserver(ask).observe(canvas);
  ask();
  return {play: () => setPlaying(true), seek: (t) => { now = t; ask(); }, choose: (block) => { chosen = block; ask(); }, pick, state: () => ({now, playing, chosen})};
}
