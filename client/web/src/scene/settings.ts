// What the controls of the page choose, and the scene that follows from it.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { type Dataset, DatasetKind } from "../generated/radiata/v1/catalog_pb";
import { ColourMap } from "../generated/radiata/v1/colour_pb";
import {
  Annotations_Convention as Convention,
  type GlyphColourSchema,
  GlyphScale_Mode as ScaleMode,
  NegativeLobes,
  Plane,
  type SceneSchema,
  Shadow,
  Uncertainty_Kind as UncertaintyKind,
  type UncertaintySchema,
  type VoxelSelectionSchema,
} from "../generated/radiata/v1/scene_pb";
import { type FibreSettings, fibreLayers, noFibres } from "./fibres";
import { type AnatomicalPlane, middleSlice, slicePosition, sliceRange } from "./slices";
import { type SurfaceSettings, defaultSurface, surfaceLayers, surfaceLight } from "./surface";

export type Region = "slice" | "slab" | "volume";

export interface Settings extends SurfaceSettings {
  readonly datasetId: string;
  readonly region: Region;
  readonly plane: AnatomicalPlane;
  /** Voxel index along the axis that the plane follows. */
  readonly slice: number;
  readonly thicknessMm: number;
  readonly scaleMode: ScaleMode;
  readonly scaleFactor: number;
  /** Highest band drawn; null: all. */
  readonly lmax: number | null;
  readonly negativeLobes: boolean;
  /** "direction", "radius", or the id of a scalar volume after "scalar:". */
  readonly colour: string;
  readonly colourMap: ColourMap;
  readonly fibres: FibreSettings;
  /** Id of the SH image that says how uncertain glyphs are, after "glyphs:" or "deviations:" for what it holds; empty: not shown. */
  readonly uncertainty: string;
  readonly shadow: Shadow;
  readonly occlusion: boolean;
  readonly convention: Convention;
}

export function defaultSettings(dataset: Dataset): Settings {
  return {
    datasetId: dataset.id,
    region: "slice",
    plane: Plane.AXIAL,
    slice: middleSlice(sliceRange(dataset, Plane.AXIAL)),
    thicknessMm: 5,
    scaleMode: ScaleMode.GLOBAL,
    scaleFactor: 1,
    lmax: null,
    negativeLobes: false,
    colour: "direction",
    colourMap: ColourMap.VIRIDIS,
    ...defaultSurface,
    fibres: noFibres,
    uncertainty: "",
    shadow: Shadow.NONE,
    occlusion: false,
    convention: Convention.RADIOLOGICAL,
  };
}

/** What may colour a dataset's glyphs: volumes with as many voxels. Whether they lie at the same place the server checks. */
export function colourChoices(dataset: Dataset, all: readonly Dataset[]): string[] {
  const lengths = (size: readonly number[]): string => [...size].sort((a, b) => a - b).join();
  const fitting = all.filter(({ kind, size }) => kind === DatasetKind.SCALAR_VOLUME && lengths(size) === lengths(dataset.size));
  return ["direction", "radius", ...fitting.map(({ id }) => `scalar:${id}`)];
}

/** Volumes that have isosurfaces. */
export const surfaceChoices = (all: readonly Dataset[]): string[] =>
  all.filter(({ kind }) => kind === DatasetKind.SCALAR_VOLUME).map(({ id }) => id);

/** What may say how uncertain a dataset's glyphs are: SH images with as many voxels. */
export function uncertaintyChoices(dataset: Dataset, all: readonly Dataset[]): string[] {
  const fitting = all.filter(
    ({ id, kind, size }) => kind === DatasetKind.SH_IMAGE && id !== dataset.id && size.join() === dataset.size.join(),
  );
  return fitting.flatMap(({ id }) => [`glyphs:${id}`, `deviations:${id}`]);
}

function uncertainty(choice: string): MessageInitShape<typeof UncertaintySchema> {
  const [kind, datasetId] = choice.split(":");
  return { datasetId, kind: kind === "deviations" ? UncertaintyKind.DEVIATIONS : UncertaintyKind.GLYPHS };
}

export const isMapped = (colour: string): boolean => colour !== "direction";

function glyphColour({ colour, colourMap: map }: Settings): MessageInitShape<typeof GlyphColourSchema> {
  if (colour === "radius") return { source: { case: "radius", value: { map } } };
  if (!isMapped(colour)) return { source: { case: "direction", value: {} } };
  return { source: { case: "scalar", value: { imageId: colour.slice("scalar:".length), map } } };
}

/** The same choices for another dataset or plane: the slice goes back to the middle, a band limit that it lacks is lifted. */
export function adapt(settings: Settings, dataset: Dataset): Settings {
  return {
    ...settings,
    datasetId: dataset.id,
    slice: middleSlice(sliceRange(dataset, settings.plane)),
    lmax: settings.lmax !== null && settings.lmax > dataset.lmax ? null : settings.lmax,
    uncertainty: dataset.id !== settings.datasetId ? "" : settings.uncertainty,
    colour: dataset.id !== settings.datasetId && settings.colour.startsWith("scalar:") ? "direction" : settings.colour,
  };
}

/** Whether the camera that fits one does not fit the other. */
export const needsNewCamera = (a: Settings, b: Settings): boolean =>
  a.datasetId !== b.datasetId || a.region !== b.region || a.plane !== b.plane || a.convention !== b.convention;

export function selection(settings: Settings, dataset: Dataset): MessageInitShape<typeof VoxelSelectionSchema> {
  if (settings.region === "volume") return { region: { case: "volume", value: {} } };
  const [x, y, z] = slicePosition(dataset, sliceRange(dataset, settings.plane), settings.slice);
  const slice = { plane: settings.plane, positionMm: { x, y, z } };
  return settings.region === "slab"
    ? { region: { case: "slab", value: { middle: slice, thicknessMm: settings.thicknessMm } } }
    : { region: { case: "slice", value: slice } };
}

export function scene(settings: Settings, dataset: Dataset): MessageInitShape<typeof SceneSchema> {
  const illumination = surfaceLight(settings);
  return {
    layers: [
      {
        content: {
          case: "glyphs",
          value: {
            datasetId: settings.datasetId,
            selection: selection(settings, dataset),
            scale: { mode: settings.scaleMode, factor: settings.scaleFactor },
            ...(settings.lmax !== null && { lmax: settings.lmax }),
            ...(settings.colour !== "direction" && { colour: glyphColour(settings) }),
            ...(settings.uncertainty !== "" && { uncertainty: uncertainty(settings.uncertainty) }),
            negativeLobes: settings.negativeLobes ? NegativeLobes.SHOWN : NegativeLobes.HIDDEN,
          },
        },
      },
      ...surfaceLayers(settings),
      ...fibreLayers(settings.fibres),
    ],
    ...((illumination || settings.shadow !== Shadow.NONE || settings.occlusion) && {
      light: {
        ...(illumination && { illumination }),
        ...(settings.shadow !== Shadow.NONE && { shadow: settings.shadow }),
        ...(settings.occlusion && { ambientOcclusion: {} }),
      },
    }),
    annotations: { convention: settings.convention },
  };
}
