// How long to wait before the next attempt to connect: doubling from 0.25 s to 5 s, with some chance so that the browsers
// of one server do not all come back at once.

export class Backoff {
  private attempts = 0;

  constructor(private readonly random: () => number = Math.random) {}

  /** Waiting time in ms; grows with each call. Between 50 % and 100 % of the nominal time. */
  next(): number {
    const nominal = Math.min(250 * 2 ** this.attempts, 5000);
    this.attempts += 1;
    return nominal * (0.5 + 0.5 * this.random());
  }

  reset(): void {
    this.attempts = 0;
  }
}
