// Undo and redo without limit. States share what they have in common, so that keeping them is cheap.

/** @template State */
export class History {
  /** @type {{state: State, label: string}[]} */
  #past = [];
  /** @type {{state: State, label: string}[]} */
  #future = [];
  /** What the last change may be merged with. @type {string | undefined} */
  #merge;

  /** @param {State} state */
  constructor(state) {
    this.state = state;
  }

  /** What undo would undo. */
  get undoLabel() {
    return this.#past.at(-1)?.label;
  }

  /** What redo would redo. */
  get redoLabel() {
    return this.#future.at(-1)?.label;
  }

  /**
   * @param {State} state
   * @param {string} label
   * @param {string} [merge] a change with the same word as the one before it is undone with it
   */
  push(state, label, merge) {
    if (merge === undefined || merge !== this.#merge || this.#past.length === 0) {
      this.#past.push({ state: this.state, label });
    }
    this.#merge = merge;
    this.#future = [];
    this.state = state;
  }

  /** Changes the state without a step of its own, such as a selection. @param {State} state */
  amend(state) {
    this.#merge = undefined;
    this.state = state;
  }

  undo() {
    const step = this.#past.pop();
    if (!step) return false;
    this.#future.push({ state: this.state, label: step.label });
    this.state = step.state;
    this.#merge = undefined;
    return true;
  }

  redo() {
    const step = this.#future.pop();
    if (!step) return false;
    this.#past.push({ state: this.state, label: step.label });
    this.state = step.state;
    this.#merge = undefined;
    return true;
  }
}
