// The keyboard: what each key does, told to people in the page's help line (index.html).
import { type Moves } from "./gestures";

export interface KeyMoves extends Moves {
  /** By so many slices. */
  slice: (step: number) => void;
  reset: () => void;
}

const kOrbitDeg = 5;
const kPan = 0.05;
const kZoom = 1.15;

const kArrows: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Carries out what a key means. \return whether it means anything. */
export function press(key: string, shift: boolean, moves: KeyMoves): boolean {
  const arrow = kArrows[key];
  if (arrow) {
    const [x, y] = arrow;
    if (shift) moves.pan(x * kPan, y * kPan);
    else moves.orbit(-x * kOrbitDeg, -y * kOrbitDeg);
    return true;
  }
  switch (key) {
    case "+":
    case "=":
      moves.zoom(kZoom, 0, 0);
      return true;
    case "-":
    case "_":
      moves.zoom(1 / kZoom, 0, 0);
      return true;
    case "PageUp":
      moves.slice(1);
      return true;
    case "PageDown":
      moves.slice(-1);
      return true;
    case "r":
    case "R":
      moves.reset();
      return true;
    default:
      return false;
  }
}

export function listenToKeys(moves: KeyMoves): void {
  globalThis.addEventListener("keydown", (event) => {
    const target = event.target;
    // A focused control keeps its own keys, but for the two that it has no use for.
    const inControl = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (inControl && event.key !== "PageUp" && event.key !== "PageDown") return;
    if (press(event.key, event.shiftKey, moves)) event.preventDefault();
  });
}
