// The isosurface of a scene: which one, its colour, and the light on it.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { type IlluminationSchema } from "../generated/radiata/v1/illumination_pb";
import { SurfaceShading } from "../generated/radiata/v1/isosurface_pb";
import { type LayerSchema } from "../generated/radiata/v1/scene_pb";

/** Local light as glyphs have it, by Lambert or by Phong; or light that is shadowed: of an even sky, or with bounces. */
export type Shading = "local" | "lambert" | "phong" | "vicinity" | "full";
export const isShading = (word: string): word is Shading => ["local", "lambert", "phong", "vicinity", "full"].includes(word);

export interface SurfaceSettings {
  /** Id of the scalar volume whose isosurface is shown; empty: none. */
  readonly surface: string;
  /** null: the value that splits the volume best in two. */
  readonly isovalue: number | null;
  readonly surfaceOpacity: number;
  readonly surfaceShading: Shading;
  /** Id of the scalar volume that colours it; empty: one colour. */
  readonly surfaceColour: string;
}

export const defaultSurface: SurfaceSettings = {
  surface: "",
  isovalue: null,
  surfaceOpacity: 0.4,
  surfaceShading: "local",
  surfaceColour: "",
};

/** Whether texels light it; such a surface is opaque. */
export const isGlobal = ({ surfaceShading }: SurfaceSettings): boolean => surfaceShading === "vicinity" || surfaceShading === "full";

export function surfaceLayers(settings: SurfaceSettings): MessageInitShape<typeof LayerSchema>[] {
  const { surface, isovalue, surfaceOpacity, surfaceShading, surfaceColour } = settings;
  if (surface === "") return [];
  const shading = surfaceShading === "phong" ? SurfaceShading.PHONG : surfaceShading === "lambert" ? SurfaceShading.LAMBERT : null;
  const value = {
    datasetId: surface,
    ...(isovalue !== null && { isovalue }),
    ...(shading !== null && { shading }),
    ...(surfaceColour !== "" && { colourBy: { imageId: surfaceColour } }),
  };
  return [{ content: { case: "isosurface", value }, opacity: isGlobal(settings) ? 1 : surfaceOpacity }];
}

/** Global light of the scene, or none. */
export function surfaceLight(settings: SurfaceSettings): MessageInitShape<typeof IlluminationSchema> | null {
  if (settings.surface === "" || !isGlobal(settings)) return null;
  return settings.surfaceShading === "vicinity" ? { bounces: 0, sky: { radiance: { x: 1, y: 1, z: 1 } } } : { suns: [{}] };
}
