"use strict";
(() => {
  const root = document.documentElement;
  const styles = JSON.parse(document.getElementById("styles").textContent);
  const PRINT_WIDTH = 690; // CSS pixels between the margins of A4
  const PRINT_SCALE = 0.78; // of a figure's height: two fit on a page
  let figures = new Map();
  const plots = [...document.querySelectorAll(".plot")];
  const wide = { displaylogo: false, responsive: true, showSendToCloud: false, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
  let theme = "light";
  let printing = false;

  // Library and figures are compressed; arrays follow the figures' JSON, bytes of equal weight side by side.
  const unpacked = async (id) => {
    const text = atob(document.getElementById(id).textContent);
    const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  };
  const KINDS = { f8: Float64Array, f4: Float32Array, i4: Int32Array, i2: Int16Array, i1: Int8Array, u4: Uint32Array, u2: Uint16Array, u1: Uint8Array };
  const loaded = async () => {
    const [library, packed] = await Promise.all(["library", "figures"].map(unpacked));
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(library);
    document.head.append(script);
    const size = new DataView(packed).getUint32(0, true);
    const arrays = new Uint8Array(packed, 4 + size);
    const shaped = (flat, [first, ...rest]) => {
      if (!rest.length) return flat;
      const each = flat.length / first;
      return Array.from({ length: first }, (_, k) => shaped(flat.subarray(k * each, (k + 1) * each), rest));
    };
    const restored = (key, value) => {
      if (!value?.packed) return value;
      const [kind, place, count, shape] = value.packed;
      const wide = KINDS[kind].BYTES_PER_ELEMENT;
      const bytes = new Uint8Array(count * wide);
      for (let k = 0; k < count; k++) for (let b = 0; b < wide; b++) bytes[k * wide + b] = arrays[place + b * count + k];
      return shaped(new KINDS[kind](bytes.buffer), shape);
    };
    figures = new Map(Object.entries(JSON.parse(new TextDecoder().decode(new Uint8Array(packed, 4, size)), restored)));
  };

  // Colours of the light page exchanged for colours of the dark one, through all of a figure.
  const tinted = (value, table) => {
    if (typeof value === "string") return table[value] ?? value;
    if (Array.isArray(value)) return value.map((item) => tinted(item, table));
    if (value && typeof value === "object" && !ArrayBuffer.isView(value)) {
      return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, tinted(item, table)]));
    }
    return value;
  };

  const chosen = (key) => {
    const found = {};
    for (const select of document.querySelectorAll(`select[data-chart="${key}"]`)) found[select.dataset.key] = select.value;
    return found;
  };

  const visible = (trace, picked) => {
    const meta = trace.meta ?? {};
    const wanted = Object.keys(picked).every((key) => !(key in meta) || meta[key] === picked[key]);
    if (!Object.keys(picked).some((key) => key in meta)) return trace.visible ?? true;
    return wanted;
  };

  // A narrow page has no room for wide margins and long legends.
  const fitted = (layout, width) => {
    if (width >= 560) return layout;
    for (const [path, value] of Object.entries(layout.meta?.narrow ?? {})) set(layout, path, structuredClone(value));
    const side = layout.polar ? { l: 34, r: 34 } : { l: Math.min(layout.margin?.l ?? 40, 46), r: 8 };
    return { ...layout, font: { size: 11 }, margin: { ...layout.margin, ...side } };
  };

  const set = (layout, path, value) => {
    const names = path.split(".");
    let part = layout;
    for (const name of names.slice(0, -1)) part = part[name] ??= {};
    part[names.at(-1)] = value;
  };

  const prepared = (key, style, width) => {
    const figure = figures.get(key);
    const table = style === "dark" ? styles.exchange : {};
    const picked = chosen(key);
    const data = figure.data.map((trace) => ({ ...tinted(trace, table), visible: visible(trace, picked) }));
    const layout = tinted(structuredClone(figure.layout), table);
    layout.template = { layout: styles[style].layout };
    for (const select of document.querySelectorAll(`select[data-chart="${key}"]`)) {
      const update = JSON.parse(select.selectedOptions[0].dataset.layout || "{}");
      for (const [path, value] of Object.entries(update)) set(layout, path, structuredClone(value));
    }
    for (const name of Object.keys(layout)) {
      if (name.startsWith("yaxis") && layout[name].autorange === true) delete layout[name].range;
    }
    return { data, layout: fitted(layout, width) };
  };

  const draw = (plot) => {
    if (!figures.has(plot.dataset.chart)) return undefined; // not unpacked yet
    const style = printing ? "light" : theme;
    const width = printing ? PRINT_WIDTH : plot.clientWidth;
    const { data, layout } = prepared(plot.dataset.chart, style, width);
    if (printing) {
      layout.width = PRINT_WIDTH;
      layout.height = Math.round(PRINT_SCALE * layout.height);
      if (layout.polar) layout.margin = { ...layout.margin, b: 50 };
    }
    plot.style.height = `${layout.height}px`;
    const camera = plot._fullLayout?.scene?.camera;
    if (camera && layout.scene) layout.scene.camera = structuredClone(camera);
    // on a narrow page there is no room beside a figure, and fingers zoom
    return Plotly.react(plot, data, layout, { ...wide, displayModeBar: width < 560 ? false : "hover" });
  };

  // Print and browsers without WebGL get a picture of what is turned by hand.
  const picture = async (plot) => {
    const { data, layout } = prepared(plot.dataset.chart, "light", PRINT_WIDTH);
    const camera = plot._fullLayout?.scene?.camera;
    if (camera) layout.scene.camera = structuredClone(camera);
    const shown = data.filter((trace) => trace.visible);
    try {
      const address = await Plotly.toImage({ data: shown, layout, config: wide }, { format: "png", width: PRINT_WIDTH, height: layout.height, scale: 2 });
      let image = plot.querySelector(":scope > img");
      if (!image) {
        image = document.createElement("img");
        image.alt = plot.getAttribute("aria-label");
        plot.append(image);
      }
      image.src = address;
      plot.classList.add("pictured");
    } catch (problem) {
      plot.classList.remove("pictured"); // no WebGL: the planes below show the same levels
    }
  };
  let waiting = 0;
  const pictures = () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      for (const plot of plots) if (plot.closest(".solid")) picture(plot);
    }, 600);
  };

  const turn = document.getElementById("theme");
  const show = (wanted) => {
    theme = wanted;
    root.dataset.theme = theme;
    turn.textContent = theme === "dark" ? "Light" : "Dark";
    turn.setAttribute("aria-pressed", String(theme === "dark"));
    turn.setAttribute("aria-label", `Switch to ${theme === "dark" ? "light" : "dark"} colours`);
  };
  const kept = (() => {
    try { return localStorage.getItem("fmu-bearing-theme"); } catch { return null; }
  })();
  const dark = matchMedia("(prefers-color-scheme: dark)");
  show(kept ?? (dark.matches ? "dark" : "light"));
  const redraw = () => { for (const plot of plots) draw(plot); };
  turn.addEventListener("click", () => {
    show(theme === "dark" ? "light" : "dark");
    try { localStorage.setItem("fmu-bearing-theme", theme); } catch { /* a page without storage forgets */ }
    redraw();
  });
  dark.addEventListener("change", () => { if (!kept) { show(dark.matches ? "dark" : "light"); redraw(); } });
  document.getElementById("print").addEventListener("click", () => window.print());
  let folded = [];
  addEventListener("beforeprint", () => {
    printing = true;
    folded = [...document.querySelectorAll("details.table:not([open])")];
    for (const part of folded) part.open = true;
    redraw();
  });
  addEventListener("afterprint", () => {
    printing = false;
    for (const part of folded) part.open = false;
    redraw();
  });

  // Plotly follows the window; from wide to narrow and back figures are arranged again.
  let narrow = innerWidth < 700;
  addEventListener("resize", () => {
    if (narrow === innerWidth < 700 || printing) return;
    narrow = !narrow;
    redraw();
  });

  for (const select of document.querySelectorAll("select[data-chart]")) {
    select.addEventListener("change", () => {
      const plot = document.getElementById(`plot-${select.dataset.chart}`);
      draw(plot);
      if (plot.closest(".solid")) pictures();
    });
  }

  const links = new Map([...document.querySelectorAll("nav a")].map((link) => [link.getAttribute("href").slice(1), link]));
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) links.get(entry.target.id)?.classList.toggle("here", entry.isIntersecting);
  }, { rootMargin: "-20% 0px -70% 0px" });
  for (const section of document.querySelectorAll("main > section")) seen.observe(section);

  // One figure after the other, so that the page answers while it is drawn.
  (async () => {
    try {
      if (plots.length) await loaded();
    } catch (problem) {
      document.getElementById("old-browser").hidden = false;
      throw problem;
    }
    for (const plot of plots) {
      await draw(plot);
      if (plot.closest(".solid")) plot.on("plotly_relayout", pictures);
      await new Promise((resolve) => setTimeout(resolve));
    }
    await Promise.all(plots.filter((plot) => plot.closest(".solid")).map(picture));
    root.dataset.ready = "true";
    document.dispatchEvent(new Event("drawn"));
  })();
})();
