"use strict";
// Moves the chosen mode: a complex amplitude a moves as Re(a exp(i phase)).
(() => {
  const SIZE = 120; // SVG units of the bearing's outer radius
  const ENLARGED = 0.13; // of the pitch radius: the largest motion
  const PERIOD = 2000; // ms of one period; longer where the shaft would spin too fast to follow
  const STEPS = 96; // points round a ring
  const make = (name, attributes = {}, parent = null) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    parent?.append(node);
    return node;
  };
  const at = ([re, im], phase) => re * Math.cos(phase) - im * Math.sin(phase);
  const size = ([re, im]) => Math.hypot(re, im);

  for (const source of document.querySelectorAll("script.shapes-data")) {
    const data = JSON.parse(source.textContent);
    const box = document.getElementById(source.id.slice("data-".length));
    if (data.branches.length) set(box, data);
    else box.hidden = true;
  }

  function set(box, { bearing, branches, chosen }) {
    const [mode, speed, pause, words, svg] = ["mode", "speed", "pause", "words", "picture"].map((name) => box.querySelector(`.shape-${name}`));
    const scale = SIZE / bearing.outer[1];
    const amplitude = ENLARGED * bearing.pitch;
    svg.setAttribute("viewBox", "0 0 420 300");
    const front = make("g", { transform: "translate(146 152)" }, svg);
    const side = make("g", { transform: "translate(356 152)" }, svg);
    let [branch, place] = chosen;
    let phase = 0;
    let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    const point = () => branches[branch].points[place];

    // Where things are at rest.
    for (const radius of [...bearing.inner, ...bearing.outer]) make("circle", { class: "rest", r: scale * radius }, front);
    for (const [name, x, y, text] of [["front", 138, -120, ""], ["front", 132, 4, "y"], ["front", -3, -138, "z"], ["side", 50, 4, "x"]]) {
      if (text) make("text", { x, y, class: "axis" }, name === "front" ? front : side).textContent = text;
    }
    const rings = { inner: make("path", { class: "inner" }, front), outer: make("path", { class: "outer" }, front) };
    const balls = Array.from({ length: bearing.balls }, () => make("circle", { class: "ball", r: scale * bearing.ball }, front));
    const mark = make("line", { class: "shaft" }, front);
    const path = make("path", { class: "path" }, front);
    const dot = make("circle", { class: "dot", r: 4 }, front);
    const arrow = make("path", { class: "arrow" }, front);
    const way = make("text", { class: "way", y: -134 }, front);
    const cuts = ["inner", "outer"].flatMap((ring) => [0, 1].map((end) => [ring, end, make("path", { class: ring }, side)]));
    const cutBalls = [0, 1].map((end) => [end, make("circle", { class: "ball", r: scale * bearing.ball }, side)]);
    make("line", { class: "rest", x1: -48, x2: 48, y1: 0, y2: 0 }, side);

    // Displacement (x, y, z) of a ring at a point (x, r, angle), all in mm, angle from 12 o'clock about +X.
    const moved = (ring, shape, x, r, angle) => {
      const [ux, turn, uy, uz, by, bz] = shape[ring].map((value) => at(value, phase) * amplitude);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const lever = r / bearing.pitch;
      let [along, out, round] = [ux + lever * (by * c + bz * s), 0, lever * turn];
      for (const [n, a, b, px, pr, pt] of shape.flexure[ring === "inner" ? 0 : 1]) {
        const [qa, qb] = [at(a, phase) * amplitude, at(b, phase) * amplitude];
        const [cn, sn] = [Math.cos(n * angle), Math.sin(n * angle)];
        along += px * (qa * cn + qb * sn);
        out += pr * (qa * cn + qb * sn);
        round += pt * (qa * sn - qb * cn);
      }
      const y = uy + (bz * x) / bearing.pitch - out * s - round * c;
      const z = uz - (by * x) / bearing.pitch + out * c - round * s;
      return [along, y, z];
    };

    const loop = (ring, shape, r) => {
      const points = [];
      for (let k = 0; k < STEPS; k++) {
        const angle = (2 * Math.PI * k) / STEPS;
        const [, y, z] = moved(ring, shape, 0, r, angle);
        points.push(`${(scale * (y - r * Math.sin(angle))).toFixed(2)},${(-scale * (z + r * Math.cos(angle))).toFixed(2)}`);
      }
      return `M${points.join("L")}Z`;
    };

    const ballAt = (shape, angle, alternating) => shape.balls.map((row) => {
      let sum = at(row[0], phase);
      for (let k = 1; k < row.length; k++) {
        const n = (k + 1) >> 1;
        const last = row.length % 2 === 0 && k === row.length - 1;
        const pattern = last ? alternating : k % 2 ? Math.cos(n * angle) : Math.sin(n * angle);
        sum += at(row[k], phase) * pattern;
      }
      return sum * amplitude;
    });

    // The plane of the cut is the one in which more is to be seen.
    const cutAngle = (shape) => {
      const seen = (k) => ["inner", "outer"].reduce((sum, ring) => sum + size(shape[ring][k[0]]) ** 2 + size(shape[ring][k[1]]) ** 2, 0);
      return seen([3, 4]) >= 0.999 * seen([2, 5]) ? 0 : -Math.PI / 2;
    };

    const draw = () => {
      const shape = point();
      for (const ring of ["inner", "outer"]) rings[ring].setAttribute("d", bearing[ring].map((r) => loop(ring, shape, r)).join(""));
      balls.forEach((ball, j) => {
        const angle = (2 * Math.PI * j) / bearing.balls + shape.orbit * phase;
        const [, out, round] = ballAt(shape, angle, j % 2 ? -1 : 1);
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        ball.setAttribute("cx", scale * (-(bearing.pitch + out) * s - round * c));
        ball.setAttribute("cy", -scale * ((bearing.pitch + out) * c - round * s));
      });
      const cut = cutAngle(shape);
      for (const [ring, end, node] of cuts) {
        const angle = cut + end * Math.PI;
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const corners = [[-1, 0], [1, 0], [1, 1], [-1, 1]].map(([left, far]) => {
          const [x, r] = [0.5 * left * bearing.width, bearing[ring][far]];
          const [along, y, z] = moved(ring, shape, x, r, angle);
          const out = r - y * s + z * c;
          return `${(scale * (x + along)).toFixed(2)},${(-scale * out * (end ? -1 : 1)).toFixed(2)}`;
        });
        node.setAttribute("d", `M${corners.join("L")}Z`);
      }
      for (const [end, node] of cutBalls) {
        const [along, out] = ballAt(shape, cut + end * Math.PI, 1);
        node.setAttribute("cx", scale * along);
        node.setAttribute("cy", -scale * (bearing.pitch + out) * (end ? -1 : 1));
      }
      const turned = shape.shaft * phase;
      const [near, far] = [0.72 * scale * bearing.inner[0], 0.95 * scale * bearing.inner[0]];
      for (const [k, r] of [[1, near], [2, far]]) {
        mark.setAttribute(`x${k}`, -r * Math.sin(turned));
        mark.setAttribute(`y${k}`, -r * Math.cos(turned));
      }
      const [y, z] = centre(shape, phase);
      dot.setAttribute("cx", y);
      dot.setAttribute("cy", -z);
    };

    // Path of the centre of the ring that moves most, or of the end of its axis where it tilts.
    const centre = (shape, phase) => {
      const places = ["inner", "outer"].flatMap((ring) => [[shape[ring][2], shape[ring][3], 1], [shape[ring][5], shape[ring][4], -1]]);
      const [a, b, sign] = places.reduce((one, other) => (Math.hypot(size(other[0]), size(other[1])) > Math.hypot(size(one[0]), size(one[1])) ? other : one));
      const reach = (0.5 * scale * bearing.inner[0]) / Math.max(1e-9, Math.hypot(size(a), size(b)));
      return shape.order === 1 ? [reach * at(a, phase), sign * reach * at(b, phase)] : [0, 0];
    };

    const show = () => {
      const shape = point();
      const { label, colour, points } = branches[branch];
      mode.value = String(branch);
      speed.max = points.length - 1;
      speed.value = place;
      speed.setAttribute("aria-valuetext", `${shape.rpm.toLocaleString("en")} r/min`);
      const q = shape.damping > 0 ? `Q ${(0.5 / shape.damping).toFixed(0)}` : "it grows by itself";
      words.textContent = "";
      const name = document.createElement("strong");
      name.textContent = label;
      name.style.setProperty("border-left", `0.5em solid ${colour}`);
      name.style.setProperty("padding-left", "0.4em");
      const wave = shape.order ? `${shape.order} wave${shape.order > 1 ? "s" : ""} round` : "the same all round";
      words.append(name, ` at ${Math.round(shape.rpm).toLocaleString("en")} r/min: ${shape.frequency.toLocaleString("en", { maximumFractionDigits: 1 })} Hz, damping ratio ${shape.damping.toFixed(4)} (${q}), ${wave}. Kinetic energy: ${shape.what}.`);
      const trail = Array.from({ length: 73 }, (_, k) => centre(shape, (2 * Math.PI * k) / 72));
      path.setAttribute("d", shape.order === 1 ? `M${trail.map(([y, z]) => `${y.toFixed(2)},${(-z).toFixed(2)}`).join("L")}` : "");
      dot.style.display = shape.order === 1 ? "" : "none";
      // Forward is the shaft's direction: anticlockwise as seen, where the speed is positive.
      const sign = { forward: 1, backward: -1 }[shape.direction] * (shape.shaft < 0 ? -1 : 1);
      const round = (degrees, r) => `${(-r * Math.sin((degrees * Math.PI) / 180)).toFixed(1)},${(-r * Math.cos((degrees * Math.PI) / 180)).toFixed(1)}`;
      const [from, to] = [-24 * sign, 24 * sign];
      arrow.setAttribute("d", sign ? `M${round(from, 130)}A130,130 0 0 ${sign > 0 ? 0 : 1} ${round(to, 130)}M${round(to - 4 * sign, 125)}L${round(to, 130)}L${round(to - 4 * sign, 135)}` : "");
      way.textContent = shape.direction;
      way.setAttribute("x", sign > 0 ? -72 : 72);
      way.setAttribute("text-anchor", sign > 0 ? "end" : "start");
      for (const plot of document.querySelectorAll("#plot-campbell")) highlight(plot);
      draw();
    };

    const highlight = (plot) => {
      if (!plot.data) return;
      const [x, y] = [[point().rpm], [point().frequency]];
      const index = plot.data.findIndex((trace) => trace.meta?.part === "chosen");
      if (index < 0) {
        const line = { width: 2.5, color: getComputedStyle(box).getPropertyValue("--accent") };
        Plotly.addTraces(plot, { x, y, mode: "markers", meta: { part: "chosen" }, hoverinfo: "skip", marker: { symbol: "square-open", size: 17, color: line.color, line } });
      } else if (plot.data[index].x[0] !== x[0] || plot.data[index].y[0] !== y[0]) {
        Plotly.restyle(plot, { x: [x], y: [y] }, [index]);
      }
    };

    branches.forEach(({ label, points }, k) => {
      const option = document.createElement("option");
      option.value = String(k);
      option.textContent = `${label}, ${Math.round(points[points.length >> 1].frequency).toLocaleString("en")} Hz`;
      mode.append(option);
    });
    mode.addEventListener("change", () => {
      const rpm = point().rpm;
      branch = Number(mode.value);
      const apart = branches[branch].points.map((one) => Math.abs(one.rpm - rpm));
      place = apart.indexOf(Math.min(...apart));
      show();
    });
    speed.addEventListener("input", () => { place = Number(speed.value); show(); });
    const name = () => { pause.textContent = running ? "Pause" : "Move"; };
    pause.addEventListener("click", () => { running = !running; name(); if (running) requestAnimationFrame(begin); });
    const follow = () => {
      for (const plot of document.querySelectorAll("#plot-campbell")) {
        plot.on("plotly_click", (event) => {
          const found = event.points.find((one) => one.customdata?.length === 2);
          if (found) { [branch, place] = found.customdata; show(); }
        });
        // other colours draw the figure again, without the mark
        plot.on("plotly_afterplot", () => highlight(plot));
        highlight(plot);
      }
    };
    // figures may be drawn before this script runs, or after
    if (document.documentElement.dataset.ready) follow();
    else document.addEventListener("drawn", follow);

    let last = 0;
    const begin = (time) => { last = time; requestAnimationFrame(move); };
    const move = (time) => {
      if (!running) return;
      const period = PERIOD * Math.max(1, 1.5 * Math.abs(point().shaft));
      phase += (2 * Math.PI * (time - last)) / period;
      last = time;
      draw();
      requestAnimationFrame(move);
    };
    name();
    show();
    if (running) requestAnimationFrame(begin);
  }
})();
