// A number with a slider around the value that it had at the start: logarithmic for a positive modulus, else linear.

const STEPS = 1000;
const FACTOR = 30; // a logarithmic slider goes from a thirtieth to thirty times

let count = 0;

export class Slider {
  /** Calls `onInput(value)`. */
  constructor({ name, title, value, isLogarithmic }, onInput) {
    const id = `slider-${count++}`;
    this.onInput = onInput;
    this.setRange(value, isLogarithmic);
    this.row = element("div", { className: "slider", title });
    this.field = element("input", { id, type: "number", step: "any" });
    this.range = element("input", { type: "range", min: 0, max: STEPS, step: 1 });
    this.range.setAttribute("aria-label", `${name}: ${title}`);
    this.refusal = element("p", { className: "refusal", hidden: true });
    this.row.append(element("label", { htmlFor: id, textContent: name }), this.range, this.field, this.refusal);
    this.set(value);
    this.range.addEventListener("input", () => this.give(Number(this.at(this.range.value / STEPS).toPrecision(4))));
    this.field.addEventListener("change", () => {
      if (this.field.value !== "") this.give(Number(this.field.value));
    });
  }

  setRange(value, isLogarithmic) {
    if (isLogarithmic && value > 0) {
      this.at = (share) => value * FACTOR ** (2 * share - 1);
      this.share = (x) => (x > 0 ? 0.5 * (1 + Math.log(x / value) / Math.log(FACTOR)) : 0);
    } else {
      const reach = 2 * Math.abs(value) || 1;
      this.at = (share) => value + reach * (2 * share - 1);
      this.share = (x) => 0.5 * (1 + (x - value) / reach);
    }
  }

  give(value) {
    this.set(value);
    this.onInput(value);
  }

  /** Shows a value. */
  set(value) {
    this.value = value;
    this.field.value = Number(value.toPrecision(6));
    const share = Math.min(1, Math.max(0, this.share(value)));
    this.range.value = STEPS * share;
    this.range.style.setProperty("--share", `${100 * share}%`);
  }

  /** Shows the value that is in use, unless the user is at it or has to mend it. */
  follow(value) {
    if (value === this.value) this.refuse(null);
    else if (!this.range.matches(":active") && document.activeElement !== this.field && this.refusal.hidden) this.set(value);
  }

  /** Shows why the value is not taken, or with null that it is. */
  refuse(reason) {
    this.row.classList.toggle("refused", reason !== null);
    this.refusal.hidden = reason === null;
    this.refusal.textContent = reason ?? "";
  }
}

function element(tag, properties) {
  return Object.assign(document.createElement(tag), properties);
}
