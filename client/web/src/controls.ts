// The controls of the page: plain selects and inputs of index.html, and the settings that they show and change.
import { type Dataset, DatasetKind } from "./generated/radiata/v1/catalog_pb";
import { ColourMap } from "./generated/radiata/v1/colour_pb";
import { Annotations_Convention as Convention, GlyphScale_Mode as ScaleMode, Plane, Shadow } from "./generated/radiata/v1/scene_pb";
import { fibreChoices, fibreColours } from "./scene/fibres";
import { type Region, type Settings, adapt, colourChoices, isMapped, surfaceChoices, uncertaintyChoices } from "./scene/settings";
import { type AnatomicalPlane, sliceMm, sliceRange } from "./scene/slices";
import { isGlobal, isShading } from "./scene/surface";

const kPlanes: Record<string, AnatomicalPlane> = { axial: Plane.AXIAL, coronal: Plane.CORONAL, sagittal: Plane.SAGITTAL };
const kScales: Record<string, ScaleMode> = { global: ScaleMode.GLOBAL, glyph: ScaleMode.PER_GLYPH };
const kMaps: Record<string, ColourMap> = {
  viridis: ColourMap.VIRIDIS,
  inferno: ColourMap.INFERNO,
  cividis: ColourMap.CIVIDIS,
  "black-red-yellow": ColourMap.BLACK_RED_YELLOW,
  grey: ColourMap.GREY,
};
const kShadows: Record<string, Shadow> = { none: Shadow.NONE, hard: Shadow.HARD, soft: Shadow.SOFT };
const kConventions: Record<string, Convention> = {
  radiological: Convention.RADIOLOGICAL,
  neurological: Convention.NEUROLOGICAL,
};

const nameOf = <T>(names: Record<string, T>, value: T): string =>
  Object.keys(names).find((name) => names[name] === value) ?? "";

function element<T extends HTMLElement>(id: string, type: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`The page has no ${type.name} named ${id}.`);
  return found;
}

function options(select: HTMLSelectElement, entries: readonly (readonly [value: string, text: string])[], value: string): void {
  select.replaceChildren(
    ...entries.map(([entry, text]) => {
      const option = document.createElement("option");
      option.value = entry;
      option.textContent = text;
      return option;
    }),
  );
  select.value = value;
}

export class Controls {
  private readonly dataset = element("dataset", HTMLSelectElement);
  private readonly region = element("region", HTMLSelectElement);
  private readonly plane = element("plane", HTMLSelectElement);
  private readonly position = element("position", HTMLInputElement);
  private readonly positionText = element("position-text", HTMLOutputElement);
  private readonly thickness = element("thickness", HTMLInputElement);
  private readonly scale = element("scale", HTMLSelectElement);
  private readonly factor = element("factor", HTMLInputElement);
  private readonly lmax = element("lmax", HTMLSelectElement);
  private readonly colour = element("colour", HTMLSelectElement);
  private readonly colourMap = element("colour-map", HTMLSelectElement);
  private readonly negative = element("negative", HTMLInputElement);
  private readonly uncertainty = element("uncertainty", HTMLSelectElement);
  private readonly shadow = element("shadow", HTMLSelectElement);
  private readonly occlusion = element("occlusion", HTMLInputElement);
  private readonly surface = element("surface", HTMLSelectElement);
  private readonly isovalue = element("isovalue", HTMLInputElement);
  private readonly surfaceOpacity = element("surface-opacity", HTMLInputElement);
  private readonly surfaceShading = element("surface-shading", HTMLSelectElement);
  private readonly surfaceColour = element("surface-colour", HTMLSelectElement);
  private readonly fibres = element("fibres", HTMLSelectElement);
  private readonly fibreColour = element("fibre-colour", HTMLSelectElement);
  private readonly fibreSelection = element("fibre-selection", HTMLInputElement);
  private readonly fibreTubes = element("fibre-tubes", HTMLInputElement);
  private readonly fibreOpacity = element("fibre-opacity", HTMLInputElement);
  private readonly convention = element("convention", HTMLSelectElement);
  private datasets: readonly Dataset[] = [];
  private settings: Settings | null = null;

  /** \param changed  called with the settings that a person chose */
  constructor(private readonly changed: (settings: Settings) => void) {
    const on = (control: HTMLElement, apply: (settings: Settings) => Settings, event = "change"): void =>
      control.addEventListener(event, () => {
        if (this.settings) this.choose(apply(this.settings));
      });
    on(this.dataset, (s) => {
      const dataset = this.datasets.find((candidate) => candidate.id === this.dataset.value);
      return dataset ? adapt(s, dataset) : s;
    });
    on(this.region, (s) => ({ ...s, region: this.region.value as Region }));
    on(this.plane, (s) => {
      const dataset = this.current(s);
      const plane = kPlanes[this.plane.value] ?? Plane.AXIAL;
      return dataset ? adapt({ ...s, plane }, dataset) : s;
    });
    on(this.position, (s) => ({ ...s, slice: this.position.valueAsNumber }), "input");
    on(this.thickness, (s) => ({ ...s, thicknessMm: positive(this.thickness, s.thicknessMm) }));
    on(this.scale, (s) => ({ ...s, scaleMode: kScales[this.scale.value] ?? s.scaleMode }));
    on(this.factor, (s) => ({ ...s, scaleFactor: positive(this.factor, s.scaleFactor) }));
    on(this.lmax, (s) => ({ ...s, lmax: this.lmax.value === "" ? null : Number(this.lmax.value) }));
    on(this.colour, (s) => ({ ...s, colour: this.colour.value }));
    on(this.colourMap, (s) => ({ ...s, colourMap: kMaps[this.colourMap.value] ?? s.colourMap }));
    on(this.negative, (s) => ({ ...s, negativeLobes: this.negative.checked }));
    on(this.uncertainty, (s) => ({ ...s, uncertainty: this.uncertainty.value }));
    on(this.shadow, (s) => ({ ...s, shadow: kShadows[this.shadow.value] ?? s.shadow }));
    on(this.occlusion, (s) => ({ ...s, occlusion: this.occlusion.checked }));
    on(this.surface, (s) => ({ ...s, surface: this.surface.value, isovalue: null, surfaceColour: "" }));
    on(this.isovalue, (s) => ({ ...s, isovalue: Number.isFinite(this.isovalue.valueAsNumber) ? this.isovalue.valueAsNumber : null }));
    on(this.surfaceOpacity, (s) => ({ ...s, surfaceOpacity: Math.min(1, positive(this.surfaceOpacity, s.surfaceOpacity)) }));
    on(this.surfaceShading, (s) => {
      const shading = this.surfaceShading.value;
      return isShading(shading) ? { ...s, surfaceShading: shading } : s;
    });
    on(this.surfaceColour, (s) => ({ ...s, surfaceColour: this.surfaceColour.value }));
    on(this.fibres, (s) => ({ ...s, fibres: { ...s.fibres, datasetId: this.fibres.value, colour: "direction", selection: "" } }));
    on(this.fibreColour, (s) => ({ ...s, fibres: { ...s.fibres, colour: this.fibreColour.value } }));
    on(this.fibreSelection, (s) => ({ ...s, fibres: { ...s.fibres, selection: this.fibreSelection.value.trim() } }));
    on(this.fibreTubes, (s) => {
      const radius = this.fibreTubes.valueAsNumber;
      return { ...s, fibres: { ...s.fibres, tubesMm: radius > 0 ? radius : null } };
    });
    on(this.fibreOpacity, (s) => ({ ...s, fibres: { ...s.fibres, opacity: Math.min(1, positive(this.fibreOpacity, s.fibres.opacity)) } }));
    on(this.convention, (s) => ({ ...s, convention: kConventions[this.convention.value] ?? s.convention }));
  }

  /** Moves the slice by so many voxels, within its range. */
  step(by: number): void {
    const settings = this.settings;
    const dataset = settings && this.current(settings);
    if (!settings || !dataset || settings.region === "volume") return;
    const range = sliceRange(dataset, settings.plane);
    const slice = Math.min(Math.max(settings.slice + by, range.first), range.last);
    if (slice !== settings.slice) this.choose({ ...settings, slice });
  }

  show(datasets: readonly Dataset[], settings: Settings): void {
    this.datasets = datasets;
    this.settings = settings;
    const dataset = this.current(settings);
    if (!dataset) return;
    const shown = datasets.filter(({ kind }) => kind === DatasetKind.SH_IMAGE || kind === DatasetKind.TENSOR_IMAGE);
    options(this.dataset, shown.map(({ id }) => [id, id] as const), settings.datasetId);
    const colours = colourChoices(dataset, datasets);
    options(this.colour, colours.map((colour) => [colour, colour.replace("scalar:", "")] as const), settings.colour);
    this.colourMap.value = nameOf(kMaps, settings.colourMap);
    document.body.dataset.mapped = String(isMapped(settings.colour));
    this.region.value = settings.region;
    this.plane.value = nameOf(kPlanes, settings.plane);
    const range = sliceRange(dataset, settings.plane);
    this.position.min = String(range.first);
    this.position.max = String(range.last);
    this.position.value = String(settings.slice);
    const mm = `${sliceMm(dataset, range, settings.slice).toFixed(1)} mm`;
    this.positionText.value = mm;
    this.position.setAttribute("aria-valuetext", mm);
    this.thickness.value = String(settings.thicknessMm);
    this.scale.value = nameOf(kScales, settings.scaleMode);
    this.factor.value = String(settings.scaleFactor);
    const step = dataset.fullBasis ? 1 : 2;
    const bands = Array.from({ length: Math.floor(dataset.lmax / step) + 1 }, (_, index) => String(index * step));
    options(
      this.lmax,
      [["", `all (${dataset.lmax})`] as const, ...bands.map((band) => [band, band] as const)],
      settings.lmax === null ? "" : String(settings.lmax),
    );
    this.negative.checked = settings.negativeLobes;
    const images = uncertaintyChoices(dataset, datasets);
    options(this.uncertainty, [["", "not shown"] as const, ...images.map((image) => [image, image.replace(":", " of ")] as const)], settings.uncertainty);
    this.shadow.value = nameOf(kShadows, settings.shadow);
    this.occlusion.checked = settings.occlusion;
    options(this.surface, [["", "none"] as const, ...surfaceChoices(datasets).map((id) => [id, id] as const)], settings.surface);
    this.isovalue.value = settings.isovalue === null ? "" : String(settings.isovalue);
    this.surfaceOpacity.value = String(settings.surfaceOpacity);
    this.surfaceOpacity.disabled = isGlobal(settings);
    this.surfaceShading.value = settings.surfaceShading;
    const volumes = surfaceChoices(datasets).filter((id) => id !== settings.surface);
    options(this.surfaceColour, [["", "one colour"] as const, ...volumes.map((id) => [id, id] as const)], settings.surfaceColour);
    document.body.dataset.surface = String(settings.surface !== "");
    const tracts = datasets.find(({ id }) => id === settings.fibres.datasetId);
    options(this.fibres, [["", "none"] as const, ...fibreChoices(datasets).map((id) => [id, id] as const)], settings.fibres.datasetId);
    options(
      this.fibreColour,
      fibreColours(tracts).map((colour) => [colour, colour.replace(/^(column|point):/, "")] as const),
      settings.fibres.colour,
    );
    this.fibreSelection.value = settings.fibres.selection;
    this.fibreTubes.value = settings.fibres.tubesMm === null ? "" : String(settings.fibres.tubesMm);
    this.fibreOpacity.value = String(settings.fibres.opacity);
    document.body.dataset.fibres = String(settings.fibres.datasetId !== "");
    this.convention.value = nameOf(kConventions, settings.convention);
    document.body.dataset.region = settings.region;
  }

  private choose(settings: Settings): void {
    this.show(this.datasets, settings);
    this.changed(settings);
  }

  private current(settings: Settings): Dataset | undefined {
    return this.datasets.find(({ id }) => id === settings.datasetId);
  }
}

/** The number in the field if it is above zero; otherwise the former one, which `show` writes back. */
function positive(input: HTMLInputElement, former: number): number {
  return input.valueAsNumber > 0 && Number.isFinite(input.valueAsNumber) ? input.valueAsNumber : former;
}
