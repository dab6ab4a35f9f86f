// The energy in use as a text: what is typed is tried at once, and what is wrong with it is marked under the word.
//
// The address holds the energy that was typed, with its parameters: #energy=…&mu=1e5&alpha=1.3,5. Whoever opens it
// behind the address of their own program gets the same material.

const QUIET = 250; // ms without a key before the text is tried

const byId = (id) => document.getElementById(id);

export class Editor {
  constructor(link) {
    this.link = link;
    this.field = byId("energy-text");
    this.marks = byId("marks");
    this.isAhead = false; // whether the text is another than that of the energy in use
    this.isAddressTaken = false;
    this.field.addEventListener("input", () => {
      this.isAhead = true;
      this.mark([]);
      clearTimeout(this.waiting);
      this.waiting = setTimeout(() => this.give({}), QUIET);
    });
    this.field.addEventListener("scroll", () => (this.marks.scrollTop = this.field.scrollTop));
  }

  give(parameters) {
    this.link.actLater("energy", { energy: { text: this.field.value, parameters } });
  }

  /** Once: the energy that the address names, if it names one. */
  takeFromAddress() {
    if (this.isAddressTaken) return;
    this.isAddressTaken = true;
    const { energy, ...parameters } = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    if (energy === undefined) return;
    this.field.value = energy;
    this.isAhead = true;
    const values = Object.entries(parameters).map(([name, list]) => [name, list.split(",").map(Number)]);
    this.give(Object.fromEntries(values.filter(([, list]) => list.every(Number.isFinite))));
  }

  /** Shows the energy in use, unless another one is being typed. */
  follow(material) {
    const { text, is_declared: isDeclared, parameters } = material;
    if (text === this.field.value) this.accept();
    else if (!this.isAhead) this.field.value = text;
    clearTimeout(this.addressing); // a browser limits the changes of an address
    this.addressing = setTimeout(() => this.address(text, isDeclared ? parameters : null), QUIET);
  }

  /** Puts an energy that was typed, with its parameters, into the address. */
  address(text, parameters) {
    // What the address asks for has to be asked for first.
    if (!this.isAddressTaken && location.hash !== "") return;
    const hash = new URLSearchParams({ energy: text });
    for (const { name, values } of parameters ?? []) hash.append(name, values.join(","));
    const place = `${location.pathname}${location.search}${parameters ? `#${hash}` : ""}`;
    if (place !== `${location.pathname}${location.search}${location.hash}`) history.replaceState(null, "", place);
  }

  /** Shows the energy that comes next, regardless of the typed text. */
  giveUp() {
    clearTimeout(this.waiting);
    this.link.forget("energy");
    this.accept();
  }

  accept() {
    this.isAhead = false;
    this.show("");
    this.mark([]);
  }

  /** Shows why a text is not taken; the energy in use stays. */
  refuse(text, reason, mistakes) {
    if (text !== this.field.value) return; // it has changed since
    this.show(mistakes.length > 0 ? mistakes.map(({ message }) => message).join("\n") : reason);
    this.mark(mistakes.flatMap(({ place }) => (place ? [place] : [])));
  }

  show(reason) {
    byId("editor").classList.toggle("refused", reason !== "");
    byId("mistakes").hidden = reason === "";
    byId("mistakes").textContent = reason;
  }

  /** Underlines parts of the text, each a line, a column and a number of characters, counted from 1. */
  mark(places) {
    const lines = this.field.value.split("\n").map((line) => [...line]);
    const parts = [];
    lines.forEach((line, k) => {
      let from = 0;
      const here = places.filter(([at]) => at === k + 1).sort(([, one], [, other]) => one - other);
      for (const [, column, length] of here) {
        const begin = Math.max(from, column - 1);
        const end = Math.max(begin, column - 1 + length);
        parts.push(line.slice(from, begin).join(""));
        // Beyond the end of a line there is nothing to underline but a space.
        const text = line.slice(begin, end).join("") || " ";
        parts.push(Object.assign(document.createElement("mark"), { textContent: text }));
        from = end;
      }
      parts.push(`${line.slice(from).join("")}\n`);
    });
    this.marks.replaceChildren(...(places.length > 0 ? parts : []));
    this.marks.scrollTop = this.field.scrollTop;
  }
}
