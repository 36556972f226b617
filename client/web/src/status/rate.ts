// Time between the frames on the screen while the view moves; pauses do not count.

const kPauseMs = 600;
const kFrames = 20;

export class FrameRate {
  private times: number[] = [];

  /** A frame was shown at `now`, ms. */
  shown(now: number): void {
    const last = this.times[this.times.length - 1];
    if (last !== undefined && now - last > kPauseMs) this.times = [];
    this.times.push(now);
    if (this.times.length > kFrames + 1) this.times.shift();
  }

  /** Mean time between frames, ms; null while there is nothing to tell. */
  frameMs(): number | null {
    const first = this.times[0];
    const last = this.times[this.times.length - 1];
    if (first === undefined || last === undefined || this.times.length < 3) return null;
    return (last - first) / (this.times.length - 1);
  }
}
