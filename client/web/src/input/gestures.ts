// What the pointers on the picture mean: one finger or the left button orbits; two fingers, the right or middle button, or the
// left one with Shift, pan; pinching zooms; a press that does not move picks. Pure: fed with positions in picture heights, answers with moves.

export interface Moves {
  /** Degrees. */
  orbit: (azimuthDeg: number, elevationDeg: number) => void;
  /** Picture heights, right and down. */
  pan: (right: number, down: number) => void;
  /** Enlargement about a point: offsets from the picture's middle, right and down, in picture heights. */
  zoom: (factor: number, x: number, y: number) => void;
  /** What lies at a point: offsets from the picture's middle, right and down, in picture heights. */
  pick: (x: number, y: number) => void;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Half a turn for a drag over the picture's height. */
export const kDegreesPerHeight = 180;

/** How far a press may stray and still be one, picture heights: a trembling hand, not a drag. */
export const kPressHeights = 0.006;

const middle = (a: Point, b: Point): Point => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);

export class Gestures {
  private readonly pointers = new Map<number, Point>();
  private panning = false;
  /** Where the one pointer went down that has not moved since. */
  private press: Point | null = null;

  constructor(private readonly moves: Moves) {}

  down(id: number, at: Point, pan: boolean): void {
    this.pointers.set(id, at);
    this.panning = pan;
    this.press = this.pointers.size === 1 && !pan ? at : null;
  }

  up(id: number): void {
    const press = this.press;
    this.press = null;
    if (this.pointers.delete(id) && press) this.moves.pick(press.x, press.y);
  }

  /** The pointer was taken away: it meant nothing. */
  cancel(id: number): void {
    this.press = null;
    this.pointers.delete(id);
  }

  move(id: number, to: Point): void {
    const from = this.pointers.get(id);
    if (!from) return;
    if (this.press && distance(this.press, to) <= kPressHeights) return;
    this.press = null;
    const others = [...this.pointers].filter(([key]) => key !== id).map(([, point]) => point);
    this.pointers.set(id, to);
    const other = others[0];
    if (other === undefined) {
      if (this.panning) this.moves.pan(to.x - from.x, to.y - from.y);
      // The scene follows the pointer, so the camera goes the other way.
      else this.moves.orbit(-(to.x - from.x) * kDegreesPerHeight, -(to.y - from.y) * kDegreesPerHeight);
    } else if (others.length === 1) {
      const before = middle(from, other);
      const after = middle(to, other);
      this.moves.pan(after.x - before.x, after.y - before.y);
      const apart = distance(from, other);
      if (apart > 1e-6) this.moves.zoom(distance(to, other) / apart, after.x, after.y);
    }
  }
}
