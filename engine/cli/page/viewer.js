// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The view in three dimensions of a run's page: surfaces of chosen labels, and a cut through them.
'use strict';
(() => {
  const root = document.documentElement;
  const byId = (id) => document.getElementById(id);
  const canvas = byId('view');
  addEventListener('error', (event) => { root.dataset.error = event.message; });

  byId('labels-find').addEventListener('input', (event) => {
    const wanted = event.target.value.trim().toLowerCase();
    for (const row of document.querySelectorAll('#labels tbody tr')) {
      row.hidden = !row.textContent.toLowerCase().includes(wanted);
    }
  });

  const gl = canvas.getContext('webgl2', {antialias: true, stencil: true});
  if (!gl) return;  // the page says so where the view would be
  root.dataset.view = 'there';

  // --- data -------------------------------------------------------------------------------------
  const bytesOf = (id) => {
    const text = atob(byId(id).textContent.trim());
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
  };
  const data = JSON.parse(byId('view-data').textContent);
  const vertices = new Uint16Array(bytesOf('view-vertices'));
  const triangles = new Uint32Array(bytesOf('view-triangles'));
  let first = 0;
  const groups = data.groups.map(([a, b, count]) => {
    const group = {a, b, first, count};
    first += count;
    return group;
  });
  const labels = data.labels.map((label) => ({...label, groups: []}));
  for (const group of groups) {
    for (const place of [group.a, group.b]) if (place >= 0) labels[place].groups.push(group);
  }

  const add = (a, b, f = 1) => a.map((x, i) => x + f * b[i]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const scaled = (a, f) => a.map((x) => x * f);
  const step = add(data.hi, data.lo, -1).map((length) => length / 65535);
  const cornerOf = (box, shares) => shares.reduce((p, share, k) => add(p, box.edges[k], share), box.origin);

  // What the page shows at most, in a box whose sides are those of the volume's.
  const smallestBox = () => {
    const [least, most] = [[1, 1, 1], [0, 0, 0]];
    for (let i = 0; i < vertices.length; i += 3) {
      const p = data.lo.map((x, k) => x + vertices[i + k] * step[k] - data.box.origin[k]);
      data.box.edges.forEach((edge, k) => {
        const share = dot(p, edge) / dot(edge, edge);
        least[k] = Math.min(least[k], share);
        most[k] = Math.max(most[k], share);
      });
    }
    const edges = data.box.edges.map((edge, k) => scaled(edge, Math.max(most[k] - least[k], 0)));
    return {origin: cornerOf(data.box, least), edges};
  };

  // The world is moved and scaled so that this box lies around 0, its diagonal 2 long.
  const whole = smallestBox();
  const middle = cornerOf(whole, [0.5, 0.5, 0.5]);
  const scale = 2 / (Math.hypot(...whole.edges.map((edge) => Math.hypot(...edge))) || 1);
  const place = (p) => scaled(add(p, middle, -1), scale);
  const lo = place(data.lo);
  const size = scaled(add(data.hi, data.lo, -1), scale);
  const box = {origin: place(whole.origin), edges: whole.edges.map((edge) => scaled(edge, scale))};
  const reach = 1.1;

  const boxes = [...document.querySelectorAll('input[data-label]')];
  const extentOf = (chosen) => {
    const [least, most] = [[65535, 65535, 65535], [0, 0, 0]];
    for (const group of chosen) {
      for (let i = 3 * group.first; i < 3 * (group.first + group.count); ++i) {
        for (let k = 0; k < 3; ++k) {
          const x = vertices[3 * triangles[i] + k];
          if (x < least[k]) least[k] = x;
          if (x > most[k]) most[k] = x;
        }
      }
    }
    return [least, most].map((end) => place(data.lo.map((x, k) => x + end[k] * step[k])));
  };
  for (const label of labels) [label.lo, label.hi] = extentOf(label.groups);

  // --- WebGL ------------------------------------------------------------------------------------
  const shader = (type, source) => {
    const out = gl.createShader(type);
    gl.shaderSource(out, '#version 300 es\n' + source);
    gl.compileShader(out);
    if (!gl.getShaderParameter(out, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(out));
    return out;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `
    in vec3 p;
    uniform vec3 lo, size;
    uniform mat4 camera;
    out vec3 w;
    void main() { w = lo + p * size; gl_Position = camera * vec4(w, 1.0); }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `
    precision highp float;
    in vec3 w;
    uniform vec3 viewer, light;
    uniform vec4 colour, cut;
    uniform float shaded;
    out vec4 seen;
    void main() {
      if (dot(cut.xyz, w) > cut.w) discard;
      vec3 n = normalize(cross(dFdx(w), dFdy(w)));
      if (dot(n, viewer) < 0.0) n = -n;
      float bright = mix(1.0, 0.52 + 0.51 * max(dot(n, light), 0.0), shaded);
      seen = vec4(min(colour.rgb * bright, 1.0) * colour.a, colour.a);
    }`));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const at = {};
  for (const name of ['lo', 'size', 'camera', 'viewer', 'light', 'colour', 'cut', 'shaded']) at[name] = uniform(name);

  const buffer = (target, content) => {
    const out = gl.createBuffer();
    gl.bindBuffer(target, out);
    gl.bufferData(target, content, gl.STATIC_DRAW);
    return out;
  };
  const array = (content, type, indices) => {
    const out = gl.createVertexArray();
    gl.bindVertexArray(out);
    if (content instanceof WebGLBuffer) gl.bindBuffer(gl.ARRAY_BUFFER, content);
    else buffer(gl.ARRAY_BUFFER, content);
    const where = gl.getAttribLocation(program, 'p');
    gl.enableVertexAttribArray(where);
    gl.vertexAttribPointer(where, 3, type, type !== gl.FLOAT, 0, 0);
    if (indices) buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    return out;
  };
  gl.bindVertexArray(null);
  const vertexBuffer = buffer(gl.ARRAY_BUFFER, vertices);
  const surface = array(vertexBuffer, gl.UNSIGNED_SHORT, triangles);
  let wires = null;  // made when they are first asked for
  const makeWires = () => {
    const lines = new Uint32Array(2 * triangles.length);
    for (let t = 0; t < triangles.length; t += 3) {
      for (let i = 0; i < 3; ++i) {
        lines[2 * t + 2 * i] = triangles[t + i];
        lines[2 * t + 2 * i + 1] = triangles[t + (i + 1) % 3];
      }
    }
    return array(vertexBuffer, gl.UNSIGNED_SHORT, lines);
  };
  const corner = (...shares) => cornerOf(box, shares);
  const frameLines = [];
  for (const [u, v] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
    frameLines.push(...corner(0, u, v), ...corner(1, u, v), ...corner(u, 0, v), ...corner(u, 1, v),
                    ...corner(u, v, 0), ...corner(u, v, 1));
  }
  const frame = array(new Float32Array(frameLines), gl.FLOAT);
  const capBuffer = gl.createBuffer();
  const cap = array(capBuffer, gl.FLOAT);

  // --- state ------------------------------------------------------------------------------------
  // At this distance a ball of radius 1, and so the box however it is turned, just fits.
  const start = {azimuth: -55, elevation: 24, distance: 1.06, x: 0, y: 0};
  const eye = {...start};
  const cut = {axis: -1, share: 0.5, side: 1};
  let edges = false;

  const sine = (degrees) => Math.sin(degrees * Math.PI / 180);
  const cosine = (degrees) => Math.cos(degrees * Math.PI / 180);
  const axes = () => {
    const [ca, sa, ce, se] = [cosine(eye.azimuth), sine(eye.azimuth), cosine(eye.elevation), sine(eye.elevation)];
    return {right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], viewer: [ce * ca, ce * sa, se]};
  };
  const cutPlane = () => {
    if (cut.axis < 0) return [0, 0, 0, 1];
    const edge = box.edges[cut.axis];
    const normal = scaled(edge, cut.side / (Math.hypot(...edge) || 1));
    return [...normal, dot(normal, add(box.origin, edge, cut.share)) + 1e-6];
  };

  // A perspective of a narrow angle, columns first.
  const kFocus = 3.6;
  const cameraMatrix = ({right, up, viewer}) => {
    const far = kFocus * eye.distance;
    const aspect = canvas.width / canvas.height;
    const fx = kFocus / Math.max(1, aspect);
    const fy = kFocus * Math.min(1, aspect);
    const [near, back] = [Math.max(far - reach, 0.02), far + reach];
    const [c, d] = [(back + near) / (near - back), 2 * back * near / (near - back)];
    const out = [];
    for (let k = 0; k < 3; ++k) out.push(fx * right[k], fy * up[k], c * viewer[k], -viewer[k]);
    out.push(fx * eye.x, fy * eye.y, d - c * far, far);
    return out;
  };

  // --- names of the box's sides -----------------------------------------------------------------
  const sides = {ras: ['LR', 'PA', 'IS'], lps: ['RL', 'AP', 'IS']}[data.frame];
  const endsOf = (edge, k) => {
    if (!sides) return ['', 'xyz'[k]];
    const sizes = edge.map(Math.abs);
    const axis = sizes.indexOf(Math.max(...sizes));
    const ends = [...sides[axis]];
    return edge[axis] < 0 ? ends.reverse() : ends;
  };
  const signs = box.edges.flatMap((edge, k) => endsOf(edge, k).map((text, end) => {
    const element = document.createElement('span');
    element.textContent = text;
    canvas.parentElement.append(element);
    const out = (end - 0.5) * (1 + 0.16 / (Math.hypot(...edge) || 1));
    return {element, at: scaled(edge, out)};
  }));
  const placeSigns = (camera, viewer) => {
    for (const {element, at: p} of signs) {
      const [x, y, , w] = [0, 1, 2, 3].map((row) => dot(p, [camera[row], camera[row + 4], camera[row + 8]]) + camera[row + 12]);
      element.style.left = `${50 + 50 * x / w}%`;
      element.style.top = `${50 - 50 * y / w}%`;
      element.style.opacity = dot(p, viewer) < 0 ? 0.45 : 1;
    }
  };

  // --- drawing ----------------------------------------------------------------------------------
  const shows = (index) => index >= 0 && labels[index].on;
  const colourOf = (label, alpha = 1) => gl.uniform4f(at.colour, ...label.colour.map((x) => x / 255), alpha);
  const ownPlaces = () => { gl.uniform3f(at.lo, 0, 0, 0); gl.uniform3f(at.size, 1, 1, 1); };
  const meshPlaces = () => { gl.uniform3f(at.lo, ...lo); gl.uniform3f(at.size, ...size); };

  const drawSurfaces = () => {
    gl.bindVertexArray(surface);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.uniform1f(at.shaded, 1);
    for (const group of groups) {
      if (shows(group.a) === shows(group.b)) continue;
      colourOf(labels[shows(group.a) ? group.a : group.b]);
      gl.drawElements(gl.TRIANGLES, 3 * group.count, gl.UNSIGNED_INT, 12 * group.first);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
  };

  const drawWires = () => {
    wires ??= makeWires();
    gl.bindVertexArray(wires);
    gl.enable(gl.BLEND);
    gl.uniform1f(at.shaded, 0);
    gl.uniform4f(at.colour, 0, 0, 0, 0.35);
    for (const group of groups) {
      if (shows(group.a) === shows(group.b)) continue;
      gl.drawElements(gl.LINES, 6 * group.count, gl.UNSIGNED_INT, 24 * group.first);
    }
    gl.disable(gl.BLEND);
  };

  const crosses = (label, plane) => {
    let [least, most] = [-plane[3], -plane[3]];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [plane[k] * label.lo[k], plane[k] * label.hi[k]];
      least += Math.min(a, b);
      most += Math.max(a, b);
    }
    return least <= 0 && most >= 0;
  };

  // The part of the cut that is in a label: where an odd number of its triangles lies behind.
  const markInside = (label, plane) => {
    gl.clear(gl.STENCIL_BUFFER_BIT);
    gl.colorMask(false, false, false, false);
    gl.depthMask(false);
    gl.disable(gl.DEPTH_TEST);
    gl.stencilFunc(gl.ALWAYS, 0, 1);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INVERT);
    meshPlaces();
    gl.uniform4f(at.cut, ...plane);
    gl.bindVertexArray(surface);
    for (const group of label.groups) {
      gl.drawElements(gl.TRIANGLES, 3 * group.count, gl.UNSIGNED_INT, 12 * group.first);
    }
    gl.colorMask(true, true, true, true);
    gl.depthMask(true);
    gl.enable(gl.DEPTH_TEST);
  };

  const drawCaps = (plane) => {
    const c = [0, 0, 0];
    c[cut.axis] = cut.share;
    const [u, v] = [(cut.axis + 1) % 3, (cut.axis + 2) % 3];
    const corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([i, j]) => {
      const p = [...c];
      p[u] = i;
      p[v] = j;
      return corner(...p);
    });
    gl.bindBuffer(gl.ARRAY_BUFFER, capBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners.flat()), gl.DYNAMIC_DRAW);
    gl.enable(gl.STENCIL_TEST);
    for (const label of labels) {
      if (!label.on || !crosses(label, plane)) continue;
      markInside(label, plane);
      gl.stencilFunc(gl.EQUAL, 1, 1);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
      ownPlaces();
      gl.uniform4f(at.cut, 0, 0, 0, 1);
      gl.uniform1f(at.shaded, 0);
      colourOf(label);
      gl.bindVertexArray(cap);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    gl.disable(gl.STENCIL_TEST);
  };

  const drawFrame = () => {
    ownPlaces();
    gl.uniform4f(at.cut, 0, 0, 0, 1);
    gl.uniform1f(at.shaded, 0);
    gl.uniform4f(at.colour, 0.5, 0.52, 0.55, 0.45);
    gl.enable(gl.BLEND);
    gl.bindVertexArray(frame);
    gl.drawArrays(gl.LINES, 0, frameLines.length / 3);
    gl.disable(gl.BLEND);
  };

  const draw = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((x) => Math.max(1, Math.round(x * ratio)));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    const view = axes();
    const light = add(add(view.viewer, view.up, 0.5), view.right, -0.35);
    const plane = cutPlane();
    const camera = cameraMatrix(view);
    placeSigns(camera, view.viewer);
    gl.uniformMatrix4fv(at.camera, false, camera);
    gl.uniform3f(at.viewer, ...view.viewer);
    gl.uniform3f(at.light, ...scaled(light, 1 / Math.hypot(...light)));
    gl.uniform4f(at.cut, ...plane);
    meshPlaces();
    drawSurfaces();
    if (edges) drawWires();
    if (cut.axis >= 0) drawCaps(plane);
    drawFrame();
    root.dataset.view = gl.getError() === gl.NO_ERROR ? 'drawn' : 'failed';
  };

  let queued = false;
  const redraw = () => {
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => { queued = false; draw(); });
  };

  // --- hands ------------------------------------------------------------------------------------
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) || 1};
  };
  const zoom = (factor) => { eye.distance = Math.min(4, Math.max(0.12, eye.distance * factor)); };
  const pan = (dx, dy) => {
    const unit = 2 * eye.distance / canvas.clientHeight;
    eye.x += dx * unit;
    eye.y -= dy * unit;
  };
  const turn = (dx, dy) => {
    eye.azimuth -= dx * 0.4;
    eye.elevation = Math.min(90, Math.max(-90, eye.elevation + dy * 0.4));
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener('pointermove', (event) => {
    const old = pointers.get(event.pointerId);
    if (!old) return;
    const next = {x: event.clientX, y: event.clientY};
    if (pointers.size === 2) {
      const before = spread();
      pointers.set(event.pointerId, next);
      const after = spread();
      zoom(before.apart / after.apart);
      pan(after.x - before.x, after.y - before.y);
    } else {
      (event.buttons & 2 || event.shiftKey ? pan : turn)(next.x - old.x, next.y - old.y);
      pointers.set(event.pointerId, next);
    }
    redraw();
  });
  for (const name of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.003));
    redraw();
  }, {passive: false});
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20]}[event.key];
    if (step) turn(...step);
    else if (event.key === '+') zoom(0.9);
    else if (event.key === '-') zoom(1.1);
    else return;
    event.preventDefault();
    redraw();
  });

  // --- controls ---------------------------------------------------------------------------------
  const slider = byId('cut-share');
  const setCut = (axis) => {
    cut.axis = axis;
    if (axis >= 0) {
      // What is on the viewer's side goes.
      cut.side = dot(box.edges[axis], axes().viewer) < 0 ? -1 : 1;
    }
    slider.disabled = byId('cut-turn').disabled = axis < 0;
    redraw();
  };
  for (const button of document.querySelectorAll('input[name=cut]')) {
    button.addEventListener('change', () => setCut(Number(button.value)));
  }
  slider.addEventListener('input', () => { cut.share = slider.value / 1000; redraw(); });
  byId('cut-turn').addEventListener('click', () => { cut.side = -cut.side; redraw(); });
  byId('view-edges').addEventListener('change', (event) => { edges = event.target.checked; redraw(); });
  byId('view-reset').addEventListener('click', () => { Object.assign(eye, start); redraw(); });

  const read = () => {
    for (const input of boxes) labels[input.dataset.label].on = input.checked;
    redraw();
  };
  for (const input of boxes) input.addEventListener('change', read);
  const setAll = (on) => {
    for (const input of boxes) if (!input.closest('tr').hidden) input.checked = on;
    read();
  };
  byId('labels-all').addEventListener('click', () => setAll(true));
  byId('labels-none').addEventListener('click', () => setAll(false));

  new ResizeObserver(redraw).observe(canvas);
  read();
  draw();
})();
