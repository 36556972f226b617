// Slices of straight, flipped and oblique datasets, and the scenes that the controls ask for.
import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { type Dataset, DatasetKind, DatasetSchema } from "../src/generated/radiata/v1/catalog_pb";
import { ColourMap } from "../src/generated/radiata/v1/colour_pb";
import { NegativeLobes, Plane, Shadow, Uncertainty_Kind as UncertaintyKind } from "../src/generated/radiata/v1/scene_pb";
import { fibreChoices, fibreColours, noFibres } from "../src/scene/fibres";
import { adapt, colourChoices, surfaceChoices, defaultSettings, needsNewCamera, scene, selection, uncertaintyChoices } from "../src/scene/settings";
import { middleSlice, nearestAxes, sliceMm, slicePosition, sliceRange } from "../src/scene/slices";

function dataset(rows: number[], size: number[], bounds?: [number[], number[]]): Dataset {
  const vec = (v: number[]) => ({ x: v[0] ?? 0, y: v[1] ?? 0, z: v[2] ?? 0 });
  return create(DatasetSchema, {
    id: "brain", size, lmax: 8, voxelToWorld: { rows },
    ...(bounds && { boundsWorld: { minimum: vec(bounds[0]), maximum: vec(bounds[1]) } }),
  });
}

// 2 mm voxels, x flipped (left-handed storage), as most scanners write them.
const flipped = dataset([-2, 0, 0, 90, 0, 2, 0, -126, 0, 0, 2, -72], [91, 109, 91]);
// Sagittal acquisition: k runs left to right, i front to back, j upwards.
const sagittal = dataset([0, 0, 1.5, -60, -1, 0, 0, 100, 0, 1, 0, -80], [200, 180, 80]);

describe("slices", () => {
  it("finds the voxel axis of each plane", () => {
    expect(nearestAxes(flipped)).toEqual([0, 1, 2]);
    expect(nearestAxes(sagittal)).toEqual([2, 0, 1]);
    const c = Math.cos(0.6);
    const s = Math.sin(0.6);
    expect(nearestAxes(dataset([c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0], [10, 10, 10]))).toEqual([0, 1, 2]);
  });

  it("gives the world position of a slice", () => {
    const range = sliceRange(flipped, Plane.SAGITTAL);
    expect(range).toMatchObject({ axis: 0, world: 0, first: 0, last: 90 });
    expect(slicePosition(flipped, range, 0)).toEqual([90, -18, 18]);
    expect(sliceMm(flipped, range, 90)).toBe(-90);
    expect(sliceMm(sagittal, sliceRange(sagittal, Plane.SAGITTAL), 10)).toBe(-45);
  });

  it("offers only slices that can hold glyphs", () => {
    const inside = dataset([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0], [50, 50, 50], [[0, 0, 19], [100, 100, 41]]);
    const range = sliceRange(inside, Plane.AXIAL);
    expect([range.first, range.last]).toEqual([10, 20]);
    expect(middleSlice(range)).toBe(15);
  });

  it("offers all slices of a dataset without usable bounds", () => {
    const empty = dataset([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0], [5, 6, 7], [[500, 500, 500], [500, 500, 500]]);
    expect(sliceRange(empty, Plane.CORONAL)).toMatchObject({ first: 0, last: 5 });
  });
});

describe("settings", () => {
  it("ask for the middle axial slice first", () => {
    const settings = defaultSettings(flipped);
    expect(selection(settings, flipped)).toEqual({
      region: { case: "slice", value: { plane: Plane.AXIAL, positionMm: { x: 0, y: -18, z: 18 } } },
    });
  });

  it("carry the choices into the scene", () => {
    const settings = { ...defaultSettings(flipped), region: "volume" as const, lmax: 0, negativeLobes: true };
    const layer = scene(settings, flipped).layers?.[0]?.content;
    expect(layer?.case).toBe("glyphs");
    expect(layer?.value).toMatchObject({
      datasetId: "brain", lmax: 0, negativeLobes: NegativeLobes.SHOWN, selection: { region: { case: "volume" } },
    });
  });

  it("leave out the band limit when all bands are wanted", () => {
    expect(scene(defaultSettings(flipped), flipped).layers?.[0]?.content?.value).not.toHaveProperty("lmax");
  });

  it("adapt to a dataset with fewer bands", () => {
    const small = create(DatasetSchema, { ...sagittal, id: "small", lmax: 4 });
    expect(adapt({ ...defaultSettings(flipped), lmax: 8 }, small)).toMatchObject({ datasetId: "small", lmax: null });
    expect(adapt({ ...defaultSettings(flipped), lmax: 2 }, small)).toMatchObject({ lmax: 2 });
  });

  it("keep the camera while only the slice or the look changes", () => {
    const settings = defaultSettings(flipped);
    expect(needsNewCamera(settings, { ...settings, slice: 3, negativeLobes: true, scaleFactor: 2 })).toBe(false);
    expect(needsNewCamera(settings, { ...settings, plane: Plane.CORONAL })).toBe(true);
  });

  it("colour glyphs by volumes of as many voxels only", () => {
    const volume = (id: string, size: number[]) => create(DatasetSchema, { id, size, kind: DatasetKind.SCALAR_VOLUME });
    const all = [flipped, volume("fa", [91, 109, 91]), volume("turned", [109, 91, 91]), volume("other", [91, 109, 90])];
    expect(colourChoices(flipped, all)).toEqual(["direction", "radius", "scalar:fa", "scalar:turned"]);
    const settings = { ...defaultSettings(flipped), colour: "scalar:fa", colourMap: ColourMap.CIVIDIS };
    expect(scene(settings, flipped).layers?.[0]?.content?.value).toMatchObject({
      colour: { source: { case: "scalar", value: { imageId: "fa", map: ColourMap.CIVIDIS } } },
    });
    expect(adapt(settings, flipped).colour).toBe("scalar:fa");
    expect(adapt({ ...settings, datasetId: "another" }, flipped).colour).toBe("direction");
    expect(adapt({ ...settings, colour: "radius", datasetId: "another" }, flipped).colour).toBe("radius");
  });

  it("add fibres with what colours them and what stands out", () => {
    const tracts = create(DatasetSchema, { id: "t", kind: DatasetKind.TRACTOGRAM, fibreColumns: ["w"], vertexColumns: ["fa"] });
    expect(fibreChoices([flipped, tracts])).toEqual(["t"]);
    expect(fibreColours(tracts).slice(-2)).toEqual(["column:w", "point:fa"]);
    const fibres = { ...noFibres, datasetId: "t", colour: "point:fa", selection: "group(a)", tubesMm: 0.4, opacity: 0.5 };
    expect(scene({ ...defaultSettings(flipped), fibres }, flipped).layers?.[1]).toEqual({
      content: {
        case: "tractogram",
        value: {
          datasetId: "t", colour: { source: { case: "point", value: { name: "fa" } } }, selected: { selection: "group(a)" },
          tubeRadiusMm: 0.4,
        },
      },
      opacity: 0.5,
    });
  });

  it("show uncertainty by images of as many voxels, and shadows", () => {
    const image = (id: string, size: number[]) => create(DatasetSchema, { id, size, kind: DatasetKind.SH_IMAGE });
    const all = [flipped, image("sd", [91, 109, 91]), image("small", [9, 9, 9])];
    expect(uncertaintyChoices(flipped, all)).toEqual(["glyphs:sd", "deviations:sd"]);
    const settings = { ...defaultSettings(flipped), uncertainty: "deviations:sd", shadow: Shadow.SOFT, occlusion: true };
    const made = scene(settings, flipped);
    expect(made.layers?.[0]?.content?.value).toMatchObject({ uncertainty: { datasetId: "sd", kind: UncertaintyKind.DEVIATIONS } });
    expect(made.light).toEqual({ shadow: Shadow.SOFT, ambientOcclusion: {} });
    expect(adapt(settings, image("sd", [91, 109, 91])).uncertainty).toBe("");
  });

  it("add the isosurface of a volume over the glyphs", () => {
    const volume = create(DatasetSchema, { id: "t1", size: [10, 10, 10], kind: DatasetKind.SCALAR_VOLUME });
    expect(surfaceChoices([flipped, volume])).toEqual(["t1"]);
    const settings = { ...defaultSettings(flipped), surface: "t1" };
    expect(scene(defaultSettings(flipped), flipped).layers).toHaveLength(1);
    expect(scene(settings, flipped).layers?.[1]).toEqual({
      content: { case: "isosurface", value: { datasetId: "t1" } },
      opacity: 0.4,
    });
    const lit = scene({ ...settings, surfaceShading: "vicinity", surfaceColour: "fa" }, flipped);
    expect(lit.layers?.[1]).toEqual({
      content: { case: "isosurface", value: { datasetId: "t1", colourBy: { imageId: "fa" } } },
      opacity: 1,
    });
    expect(lit.light?.illumination?.bounces).toBe(0);
    expect(scene({ ...settings, surfaceShading: "full" }, flipped).light?.illumination?.suns).toHaveLength(1);
    expect(scene({ ...settings, surfaceShading: "phong" }, flipped).light).toBeUndefined();
    expect(scene({ ...settings, isovalue: 30 }, flipped).layers?.[1]?.content?.value).toMatchObject({ isovalue: 30 });
  });
});
