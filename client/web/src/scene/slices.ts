// Where the slices of a dataset lie: which voxel axis an anatomical plane follows, and the world position of each slice.
import { type Dataset } from "../generated/radiata/v1/catalog_pb";
import { Plane } from "../generated/radiata/v1/scene_pb";
import { type Vec3, dot, length } from "../math/vector";

export type AnatomicalPlane = Plane.AXIAL | Plane.CORONAL | Plane.SAGITTAL;

/** World axis orthogonal to a plane: sagittal x (right), coronal y (anterior), axial z (superior). */
const kWorldAxis: Record<AnatomicalPlane, 0 | 1 | 2> = { [Plane.SAGITTAL]: 0, [Plane.CORONAL]: 1, [Plane.AXIAL]: 2 };

const kOrders: readonly (readonly [number, number, number])[] = [
  [0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0],
];

export interface SliceRange {
  /** Voxel axis along which the slices are stacked. */
  readonly axis: number;
  readonly world: 0 | 1 | 2;
  /** First and last slice that can hold glyphs, voxel indices. */
  readonly first: number;
  readonly last: number;
}

/** Column `axis` of the affine: the step to the next voxel, world mm. */
function step(dataset: Dataset, axis: number): Vec3 {
  const rows = dataset.voxelToWorld?.rows ?? [];
  return [rows[axis] ?? 0, rows[4 + axis] ?? 0, rows[8 + axis] ?? 0];
}

/** For each world axis the voxel axis nearest to it: the pairing with the largest sum of |cosine|. */
export function nearestAxes(dataset: Dataset): readonly [number, number, number] {
  const cosine = (axis: number, world: number): number => {
    const column = step(dataset, axis);
    return Math.abs(column[world] ?? 0) / (length(column) || 1);
  };
  const score = (order: readonly [number, number, number]): number =>
    cosine(order[0], 0) + cosine(order[1], 1) + cosine(order[2], 2);
  return kOrders.reduce((best, order) => (score(order) > score(best) + 1e-12 ? order : best));
}

/** Middle of slice `index`, world mm. */
export function slicePosition(dataset: Dataset, range: SliceRange, index: number): Vec3 {
  const rows = dataset.voxelToWorld?.rows ?? [];
  const voxel = [0, 1, 2].map((axis) => (axis === range.axis ? index : ((dataset.size[axis] ?? 1) - 1) / 2)) as unknown as Vec3;
  const row = (r: number): number =>
    dot([rows[4 * r] ?? 0, rows[4 * r + 1] ?? 0, rows[4 * r + 2] ?? 0], voxel) + (rows[4 * r + 3] ?? 0);
  return [row(0), row(1), row(2)];
}

/** World coordinate of slice `index` along the axis orthogonal to its plane, mm: what a person calls its position. */
export const sliceMm = (dataset: Dataset, range: SliceRange, index: number): number =>
  slicePosition(dataset, range, index)[range.world];

/** The slices of a plane whose middle lies within the bounds of the glyphs; all slices if none does. */
export function sliceRange(dataset: Dataset, plane: AnatomicalPlane): SliceRange {
  const world = kWorldAxis[plane];
  const axis = nearestAxes(dataset)[world];
  const all: SliceRange = { axis, world, first: 0, last: Math.max(0, (dataset.size[axis] ?? 1) - 1) };
  const low = dataset.boundsWorld?.minimum;
  const high = dataset.boundsWorld?.maximum;
  if (!low || !high) return all;
  const minimum = [low.x, low.y, low.z][world] ?? 0;
  const maximum = [high.x, high.y, high.z][world] ?? 0;
  const inside: number[] = [];
  for (let index = all.first; index <= all.last; ++index) {
    const mm = sliceMm(dataset, all, index);
    if (mm > minimum && mm < maximum) inside.push(index);
  }
  const first = inside[0];
  const last = inside[inside.length - 1];
  return first === undefined || last === undefined ? all : { ...all, first, last };
}

export const middleSlice = (range: SliceRange): number => Math.round((range.first + range.last) / 2);
