// The panel next to the stage: buttons, figures, the material with its sliders.

import { Editor } from "./editor.js";
import { Slider } from "./slider.js";

const byId = (id) => document.getElementById(id);
const NOTICE = 6000; // ms for which a refusal without a place of its own is shown
const SUBSCRIPTS = "₀₁₂₃₄₅₆₇₈₉";

export class Panel {
  constructor(link, onWireframe) {
    this.link = link;
    this.figures = null;
    this.sliders = new Map(); // by parameter, one for each entry
    this.timeStep = null;
    this.material = null;
    this.editor = new Editor(link);
    this.notice = null;
    const click = (id, action) =>
      byId(id).addEventListener("click", (event) => {
        event.currentTarget.blur(); // so that the space bar goes on to pause
        action();
      });
    click("pause", () => link.run({ pause: { paused: !this.figures?.paused } }));
    click("step", () => link.run({ step: {} }));
    click("reset", () => link.act({ reset: {} }));
    click("let-go", () => link.act({ release_all: {} }));
    click("save", () => link.act({ save: {} }));
    click("restore", () => {
      this.editor.giveUp();
      link.act({ restore: {} });
    });
    byId("real-time").addEventListener("change", ({ target }) => {
      link.run({ pace: { real_time: target.checked } });
    });
    byId("wireframe").addEventListener("change", ({ target }) => onWireframe(target.checked));
    byId("material").addEventListener("change", ({ target }) => {
      this.editor.giveUp();
      this.link.act({ material: { name: target.value, as_stiff: byId("as-stiff").checked } });
    });
    const keys = {
      " ": "pause", ".": "step", r: "reset", l: "let-go", s: "save", b: "restore", f: "real-time", w: "wireframe",
    };
    window.addEventListener("keydown", (event) => {
      const isTyping = event.target.matches?.("input:not([type=checkbox]):not([type=range]), select, textarea");
      const id = keys[event.key.toLowerCase()];
      if (!id || isTyping || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      byId(id).click();
    });
  }

  /** What changes with an act at most. */
  setUp(setup) {
    byId("scene").textContent = setup.scene;
    byId("about").textContent = `${capital(setup.about)}.`;
    byId("body").textContent =
      `${setup.tets} tetrahedra, ${setup.nodes} nodes, surface of ${setup.vertices} vertices. SI units.`;
    document.title = `${setup.scene} – piola`;
    document.documentElement.style.setProperty("--accent", css(setup.colour));
    byId("restore").disabled = !setup.is_saved;
    byId("save").title = `Keep the state, to come back to it${setup.file ? `, in ${setup.file}` : ""} (S)`;
    this.setTimeStep(setup);
    this.setMaterial(setup);
  }

  setTimeStep({ dt, dt_of_scene: value }) {
    if (!this.timeStep) {
      const about = { name: "Δt, s", title: "Length of the time steps to come", value, isLogarithmic: true };
      this.timeStep = new Slider(about, (seconds) => this.link.actLater("Δt", { time_step: { seconds } }));
      byId("time-step").append(this.timeStep.row);
    }
    this.timeStep.follow(dt);
  }

  setMaterial({ material, materials }) {
    const choice = byId("material");
    if (choice.options.length === 0) {
      for (const [name, summary] of materials) {
        const option = new Option(name.replaceAll("_", " "), name);
        option.title = summary;
        choice.add(option);
      }
    }
    // An energy that was typed is none of these.
    choice.selectedIndex = material.is_declared ? -1 : [...choice.options].findIndex(({ value }) => value === material.name);
    choice.title = material.summary;
    this.refuseMaterial(null);
    this.editor.follow(material);
    byId("formula").textContent = `ψ = ${material.formula}`;
    byId("formula").title = `${material.summary} Defined for ${material.domain}.`;
    const shape = (material) =>
      JSON.stringify([material?.name, material?.formula, material?.parameters.map(({ values }) => values.length)]);
    if (shape(material) !== shape(this.material)) this.makeSliders(material.parameters);
    this.material = material;
    for (const { name, values } of material.parameters) {
      this.sliders.get(name).forEach((slider, k) => slider.follow(values[k]));
    }
  }

  makeSliders(parameters) {
    this.sliders.clear();
    byId("parameters").replaceChildren();
    for (const { name, doc, is_list, values } of parameters) {
      const sliders = values.map((value, k) => {
        // A formula does not say which of its parameters are moduli; these are large in Pa.
        const isLogarithmic = doc.includes(", Pa") || value > 1e3;
        const about = { name: is_list ? name + subscript(k + 1) : name, title: doc, value, isLogarithmic };
        return new Slider(about, () => {
          this.link.actLater(name, { parameter: { name, values: sliders.map((slider) => slider.value) } });
        });
      });
      this.sliders.set(name, sliders);
      const caption = Object.assign(document.createElement("p"), { className: "caption", textContent: doc });
      byId("parameters").append(caption, ...sliders.map((slider) => slider.row));
    }
  }

  /** Why something was not done, where it was asked for. */
  refuse({ act, reason, mistakes }) {
    const [[kind, what]] = Object.entries(act);
    if (kind === "parameter") this.sliders.get(what.name)?.forEach((slider) => slider.refuse(reason));
    else if (kind === "time_step") this.timeStep.refuse(reason);
    else if (kind === "material") this.refuseMaterial(reason);
    else if (kind === "energy") this.editor.refuse(what.text, reason, mistakes);
    else {
      this.notice = reason;
      clearTimeout(this.forgetting);
      this.forgetting = setTimeout(() => (this.notice = null), NOTICE);
    }
  }

  refuseMaterial(reason) {
    byId("material-refusal").hidden = reason === null;
    byId("material-refusal").textContent = reason ?? "";
    if (reason !== null && this.material) byId("material").value = this.material.is_declared ? "" : this.material.name;
  }

  /** What changes with each step. */
  setFigures(figures) {
    this.figures = figures;
    const { inverted } = figures;
    byId("pause-text").textContent = figures.paused ? "Go on" : "Pause";
    byId("pause").classList.toggle("on", figures.paused);
    byId("let-go").disabled = figures.pulls.length === 0;
    byId("real-time").checked = figures.real_time;
    byId("time").textContent = `${fixed(figures.time, 2)} s, step ${figures.frame}`;
    byId("speed").textContent = fixed(figures.steps_per_second, 0);
    byId("newton").textContent = figures.newton_iterations;
    byId("det").textContent = fixed(figures.min_det_f, 3);
    byId("inverted").textContent = inverted;
    for (const id of ["det", "inverted"]) byId(id).parentElement.classList.toggle("alarm", inverted > 0);
    byId("from-rest").textContent = fixed(figures.from_rest, figures.from_rest < 0.01 ? 4 : 2);
    byId("energy").textContent = figures.elastic_energy === null ? "–" : joules(figures.elastic_energy);
    this.trouble(figures.trouble ?? this.notice);
  }

  setFramesPerSecond(frames) {
    byId("frames").textContent = fixed(frames, 0);
  }

  /** A word on what went wrong, or null. */
  trouble(reason) {
    byId("trouble").hidden = reason === null;
    byId("trouble").textContent = reason === null ? "" : capital(reason);
  }
}

function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** A number with a given number of digits after the point, or a dash for one that JSON cannot represent. */
function fixed(number, digits) {
  return number === null ? "–" : number.toFixed(digits);
}

function subscript(number) {
  return [...String(number)].map((digit) => SUBSCRIPTS[digit]).join("");
}

/** Energies span many orders of magnitude. */
function joules(energy) {
  const units = [[1e6, "MJ"], [1e3, "kJ"], [1, "J"], [1e-3, "mJ"]];
  const [unit, name] = units.find(([unit]) => Math.abs(energy) >= unit) ?? [1e-3, "mJ"];
  return `${Math.abs(energy / unit).toFixed(1) === "0.0" ? "0.0" : (energy / unit).toFixed(1)} ${name}`;
}

/** A linear colour in CSS. */
function css(colour) {
  const encode = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  return `rgb(${colour.map((x) => Math.round(255 * encode(x))).join(" ")})`;
}
