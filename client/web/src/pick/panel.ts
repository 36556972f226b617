// The panel that says what lies under the pixel that was clicked.
import { type Vec3 } from "../generated/radiata/v1/geometry_pb";
import { type PickedGlyph, type PickedSurface } from "../generated/radiata/v1/pick_pb";

const vector = (v: Vec3 | undefined, digits: number): string =>
  v ? [v.x, v.y, v.z].map((value) => value.toFixed(digits)).join(", ") : "–";

/** What the panel says: label and text of each row. */
export function rows(glyph: PickedGlyph): [label: string, text: string][] {
  const peaks = glyph.peaks.length;
  const rank =
    glyph.peakRank === 0
      ? `none of ${peaks}`
      : `${glyph.peakRank} of ${peaks}, ${glyph.peakAngleDeg.toFixed(1)}° away, ${(glyph.peaks[glyph.peakRank - 1]?.amplitude ?? 0).toPrecision(4)}`;
  return [
    ["voxel", glyph.voxel.join(", ")],
    ["place, mm", vector(glyph.positionMm, 2)],
    ["direction", vector(glyph.direction, 3)],
    ["radius, mm", glyph.radiusMm.toFixed(3)],
    ["amplitude", glyph.amplitude.toPrecision(4)],
    ["peak", rank],
  ];
}

/** The same of a point on an isosurface. */
export function surfaceRows(surface: PickedSurface): [label: string, text: string][] {
  return [
    ["voxel", surface.voxel.join(", ")],
    ["place, mm", vector(surface.positionMm, 2)],
    ["normal", vector(surface.normal, 3)],
    ["value", surface.value.toPrecision(4)],
  ];
}

const rowsOf = (what: PickedGlyph | PickedSurface): [label: string, text: string][] =>
  what.$typeName === "radiata.v1.PickedGlyph" ? rows(what) : surfaceRows(what);

export class PickPanel {
  constructor(private readonly element: HTMLElement) {
    element.querySelector("button")?.addEventListener("click", () => this.hide());
  }

  /** \param what  null: nothing lies there */
  show(what: PickedGlyph | PickedSurface | null): void {
    const list = this.element.querySelector("dl");
    const title = this.element.querySelector("h2");
    if (!list || !title) return;
    title.textContent = what ? what.datasetId : "nothing here";
    list.replaceChildren(
      ...(what ? rowsOf(what) : []).flatMap(([label, text]) => {
        const term = document.createElement("dt");
        const detail = document.createElement("dd");
        term.textContent = label;
        detail.textContent = text;
        detail.dataset.row = label;
        return [term, detail];
      }),
    );
    this.element.hidden = false;
  }

  hide(): void {
    this.element.hidden = true;
  }
}
