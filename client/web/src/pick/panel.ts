// The panel that says what lies under the pixel that was clicked.
import { type Vec3 } from "../generated/radiata/v1/geometry_pb";
import { type PickedFibre, type PickedGlyph, type PickedSurface } from "../generated/radiata/v1/pick_pb";

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

/** The same of a fibre, with its groups and columns. */
export function fibreRows(fibre: PickedFibre): [label: string, text: string][] {
  return [
    ["fibre", String(fibre.fibre)],
    ["point", String(fibre.point)],
    ["place, mm", vector(fibre.positionMm, 2)],
    ["tangent", vector(fibre.tangent, 3)],
    ["length, mm", fibre.lengthMm.toFixed(1)],
    ...(fibre.groups.length > 0 ? [["groups", fibre.groups.join(", ")] satisfies [string, string]] : []),
    ...fibre.values.map(({ column, numbers }): [string, string] => [
      column,
      numbers.map((number) => (Number.isNaN(number) ? "no value" : number.toPrecision(4))).join(", "),
    ]),
  ];
}

type Picked = PickedGlyph | PickedFibre | PickedSurface;

function rowsOf(what: Picked): [label: string, text: string][] {
  switch (what.$typeName) {
    case "radiata.v1.PickedGlyph":
      return rows(what);
    case "radiata.v1.PickedFibre":
      return fibreRows(what);
    case "radiata.v1.PickedSurface":
      return surfaceRows(what);
  }
}

export class PickPanel {
  constructor(private readonly element: HTMLElement) {
    element.querySelector("button")?.addEventListener("click", () => this.hide());
  }

  /** \param what  null: nothing lies there */
  show(what: Picked | null): void {
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
