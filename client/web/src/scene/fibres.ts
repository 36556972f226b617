// What the controls choose of fibres, and the layer that follows from it.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { type Dataset, DatasetKind } from "../generated/radiata/v1/catalog_pb";
import { type LayerSchema } from "../generated/radiata/v1/scene_pb";
import { type FibreColourSchema } from "../generated/radiata/v1/tractogram_pb";

export interface FibreSettings {
  /** Id of the tractogram that is shown; empty: none. */
  readonly datasetId: string;
  /** "direction", "ends", "fibre", "group", "length", or the name of a column after "column:" or "point:". */
  readonly colour: string;
  /** Fibres that stand out, as docs/formats/selection.md describes; empty: none does. */
  readonly selection: string;
  /** Radius of tubes, mm: of the fibres that stand out or else of all; null: lines. */
  readonly tubesMm: number | null;
  readonly opacity: number;
}

export const noFibres: FibreSettings = { datasetId: "", colour: "direction", selection: "", tubesMm: null, opacity: 1 };

/** Tractograms. */
export const fibreChoices = (all: readonly Dataset[]): string[] =>
  all.filter(({ kind }) => kind === DatasetKind.TRACTOGRAM).map(({ id }) => id);

/** What may colour a tractogram; columns are known once it was read. */
export const fibreColours = (dataset: Dataset | undefined): string[] => [
  "direction", "ends", "fibre", "group", "length",
  ...(dataset?.fibreColumns ?? []).map((name) => `column:${name}`),
  ...(dataset?.vertexColumns ?? []).map((name) => `point:${name}`),
];

function colourOf(colour: string): MessageInitShape<typeof FibreColourSchema> {
  if (colour.startsWith("column:")) return { source: { case: "column", value: { name: colour.slice("column:".length) } } };
  if (colour.startsWith("point:")) return { source: { case: "point", value: { name: colour.slice("point:".length) } } };
  const plain = colour as "direction" | "ends" | "fibre" | "group" | "length";
  return { source: { case: plain, value: {} } };
}

/** The layer, or none. */
export function fibreLayers(fibres: FibreSettings): MessageInitShape<typeof LayerSchema>[] {
  if (fibres.datasetId === "") return [];
  const value = {
    datasetId: fibres.datasetId,
    colour: colourOf(fibres.colour),
    ...(fibres.selection !== "" && { selected: { selection: fibres.selection } }),
    ...(fibres.tubesMm !== null && { tubeRadiusMm: fibres.tubesMm }),
  };
  return [{ content: { case: "tractogram", value }, opacity: fibres.opacity }];
}
