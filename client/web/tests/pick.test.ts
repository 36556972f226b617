// What the panel says about a picked glyph.
import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { PickedFibreSchema, PickedGlyphSchema } from "../src/generated/radiata/v1/pick_pb";
import { fibreRows, rows } from "../src/pick/panel";

const glyph = create(PickedGlyphSchema, {
  datasetId: "fod", voxel: [3, 4, 5], positionMm: { x: 1.234, y: -2, z: 100 }, direction: { x: 0, y: 0.6, z: 0.8 },
  radiusMm: 1.23456, amplitude: -0.0123456, peaks: [{ amplitude: 0.75 }, { amplitude: 0.5 }],
});

describe("the panel of a pick", () => {
  it("names voxel, place, direction, radius and amplitude", () => {
    expect(Object.fromEntries(rows(glyph))).toEqual({
      voxel: "3, 4, 5", "place, mm": "1.23, -2.00, 100.00", direction: "0.000, 0.600, 0.800", "radius, mm": "1.235",
      amplitude: "-0.01235", peak: "none of 2",
    });
  });

  it("names the peak that the point belongs to", () => {
    const second = { ...glyph, peakRank: 2, peakAngleDeg: 7.25 };
    expect(Object.fromEntries(rows(second)).peak).toBe("2 of 2, 7.3° away, 0.5000");
  });

  it("names fibre, point, place, groups and columns", () => {
    const fibre = create(PickedFibreSchema, {
      datasetId: "bundles", fibre: 15262, point: 118, positionMm: { x: -0.121, y: -15.635, z: 20.557 },
      tangent: { x: 0.9985, y: 0.0519, z: 0.0167 }, lengthMm: 117.369, groups: ["callosum", "forceps"],
      values: [{ column: "weight", numbers: [0.12345] }, { column: "ends", numbers: [1, Number.NaN] }],
    });
    expect(Object.fromEntries(fibreRows(fibre))).toEqual({
      fibre: "15262", point: "118", "place, mm": "-0.12, -15.63, 20.56", tangent: "0.999, 0.052, 0.017", "length, mm": "117.4",
      groups: "callosum, forceps", weight: "0.1235", ends: "1.000, no value",
    });
    expect(fibreRows({ ...fibre, groups: [], values: [] }).map(([label]) => label)).not.toContain("groups");
  });
});
