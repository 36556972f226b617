// Hands the pointer and wheel events of the picture to the gestures, in picture heights from its middle.
import { Gestures, type Moves, type Point } from "./gestures";

/** Enlargement for one pixel of wheel movement: about 1.2 for the notch of a mouse. */
const kZoomPerPixel = 0.0018;
const kPixelsPerLine = 32;

export function listenToPointers(element: HTMLElement, moves: Moves): void {
  const gestures = new Gestures(moves);
  const place = (event: MouseEvent): Point => {
    const box = element.getBoundingClientRect();
    return {
      x: (event.clientX - box.left - box.width / 2) / box.height,
      y: (event.clientY - box.top - box.height / 2) / box.height,
    };
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    gestures.down(event.pointerId, place(event), event.button !== 0 || event.shiftKey);
  });
  element.addEventListener("pointermove", (event) => gestures.move(event.pointerId, place(event)));
  element.addEventListener("pointerup", (event) => gestures.up(event.pointerId));
  element.addEventListener("pointercancel", (event) => gestures.cancel(event.pointerId));
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const pixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY : event.deltaY * kPixelsPerLine;
      const { x, y } = place(event);
      moves.zoom(Math.exp(-pixels * kZoomPerPixel), x, y);
    },
    { passive: false },
  );
}
