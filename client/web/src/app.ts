// Ties the page together: controls and pointers change settings and camera, the connection carries them to the server, frames come
// back to the screen and the status line.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { Code, ConnectError } from "@connectrpc/connect";
import { type Camera, cameraFrame, fromMessage, toMessage } from "./camera/camera";
import { orbit, pan, shift, zoom } from "./camera/moves";
import { Controls } from "./controls";
import { cameraJson, expose, requestJson, type ShownFrame, shownFrame } from "./debug";
import { type Dataset, DatasetKind } from "./generated/radiata/v1/catalog_pb";
import { type Frame, type FrameRequestSchema, ImageFormat } from "./generated/radiata/v1/frame_pb";
import { type KeyMoves, listenToKeys } from "./input/keys";
import { listenToPointers } from "./input/pointer";
import { subtract } from "./math/vector";
import { type PickPanel } from "./pick/panel";
import { Decoder, decodeBitmap } from "./picture/decoder";
import { type PixelLimits, Screen, fit } from "./picture/screen";
import { adapt, defaultSettings, needsNewCamera, scene, selection, type Settings } from "./scene/settings";
import { slicePosition, sliceRange } from "./scene/slices";
import { type Services } from "./service";
import { FrameRate } from "./status/rate";
import { type StatusLine } from "./status/line";
import { Connection, type ConnectionState } from "./view/connection";
import { sentence } from "./view/failures";

const kCallTimeoutMs = 10_000;
/** Fibres are thin: the nearest within so many pixels of a click is meant. */
const kPickRadiusPx = 3;
/** A large image may take its time to be read. */
const kReadTimeoutMs = 120_000;

export class App {
  private datasets: readonly Dataset[] = [];
  private settings: Settings | null = null;
  private camera: Camera | null = null;
  private limits: PixelLimits = { widthMax: 1920, heightMax: 1080, pixelsMax: 1920 * 1080 };
  private readonly screen: Screen;
  private readonly controls: Controls;
  private readonly connection: Connection;
  private readonly decoder: Decoder<ImageBitmap>;
  private readonly rate = new FrameRate();
  private connections = 0;
  private connectionState: ConnectionState = "connecting";
  private shown: ShownFrame | null = null;
  private echoed: Frame | null = null;
  private ageMs: number | null = null;
  /** Cameras by the number of the change that carried them, from the one on the screen onwards. */
  private cameras = new Map<bigint, Camera>();
  private fitting = 0;
  private picking = 0;

  constructor(
    private readonly services: Services,
    private readonly status: StatusLine,
    canvas: HTMLCanvasElement,
    private readonly picked: PickPanel,
  ) {
    this.screen = new Screen(canvas, () => this.connection.change({ ...this.pixels(), clientTimeMs: performance.now() }));
    this.controls = new Controls((settings) => void this.choose(settings));
    this.decoder = new Decoder({
      decode: decodeBitmap,
      show: ({ frame, bitmap }) => this.show(frame, bitmap),
      failed: (frame, error) => this.status.message(`Frame ${frame.sequence} could not be decoded: ${String(error)}`),
    });
    this.connection = new Connection(services, {
      prepare: (signal) => this.prepare(signal),
      request: () => this.request(),
      frame: (frame, acknowledge) => this.decoder.push(frame, acknowledge),
      state: (state, reason) => this.connectionChanged(state, reason),
      refused: (reason) => this.status.message(reason),
      numbered: (sequence) => this.camera && this.cameras.set(sequence, this.camera),
    });
    const moves: KeyMoves = {
      orbit: (azimuth, elevation) => this.move((camera) => orbit(camera, azimuth, elevation)),
      pan: (right, down) => this.move((camera) => pan(camera, right, down)),
      zoom: (factor, x, y) => this.move((camera) => zoom(camera, factor, x, y)),
      pick: (x, y) => void this.pick(x, y),
      slice: (step) => this.controls.step(step),
      reset: () => void this.refit(),
    };
    listenToPointers(canvas, moves);
    listenToKeys(moves);
    expose({
      camera: () => cameraJson(this.camera),
      shownCamera: () => cameraJson(this.cameras.get(BigInt(this.shown?.cameraSequence ?? 0))),
      request: () => requestJson(this.echoed),
      lastFrame: () => this.shown,
      connection: () => this.connectionState,
    });
  }

  run(): Promise<void> {
    return this.connection.run();
  }

  /** Asks the server what it has; a restarted one may have other datasets. */
  private async prepare(signal: AbortSignal): Promise<void> {
    const options = { signal, timeoutMs: kCallTimeoutMs };
    const [catalog, limits] = await Promise.all([
      this.services.catalog.listDatasets({}, options),
      this.services.limits.getLimits({}, options),
    ]);
    this.limits = { widthMax: limits.widthMax, heightMax: limits.heightMax, pixelsMax: Number(limits.pixelsMax) };
    this.datasets = catalog.datasets;
    const former = this.settings;
    const known = this.dataset(former);
    const dataset = known ? await this.details(known.id, signal) : await this.first(signal);
    if (!former) this.settings = defaultSettings(dataset);
    else if (!known) this.settings = adapt(former, dataset);
    if (!this.camera || this.settings?.datasetId !== former?.datasetId) await this.fitCamera(signal);
    if (this.settings) this.controls.show(this.datasets, this.settings);
  }

  /** The list names datasets that the server has not read yet, without size and place; asking for one makes it read it. */
  private async details(id: string, signal: AbortSignal): Promise<Dataset> {
    const { dataset } = await this.services.catalog.getDataset({ id }, { signal, timeoutMs: kReadTimeoutMs });
    if (!dataset) throw new ConnectError(`The server told nothing about ${id}.`, Code.Internal);
    this.datasets = this.datasets.map((other) => (other.id === id ? dataset : other));
    return dataset;
  }

  /** The first dataset that can be read. */
  private async first(signal: AbortSignal): Promise<Dataset> {
    let failure: unknown = new ConnectError("The server has no datasets to show.", Code.Unavailable);
    for (const { id, kind } of this.datasets) {
      if (kind !== DatasetKind.SH_IMAGE && kind !== DatasetKind.TENSOR_IMAGE) continue;
      try {
        return await this.details(id, signal);
      } catch (error) {
        failure = error;
        if (signal.aborted) break;
      }
    }
    throw failure;
  }

  private dataset(settings: Settings | null): Dataset | undefined {
    return settings ? this.datasets.find(({ id }) => id === settings.datasetId) : undefined;
  }

  private pixels(): { width: number; height: number } {
    return fit(this.screen.size, this.limits);
  }

  private request(): MessageInitShape<typeof FrameRequestSchema> {
    const dataset = this.dataset(this.settings);
    if (!dataset || !this.settings || !this.camera) throw new ConnectError("There is nothing to show yet.", Code.Unavailable);
    this.cameras = new Map([[0n, this.camera]]);
    return { scene: scene(this.settings, dataset), camera: toMessage(this.camera), ...this.pixels() };
  }

  /** Asks what lies at a point of the frame on the screen; offsets from its middle in picture heights. */
  private async pick(right: number, down: number): Promise<void> {
    const frame = this.shown;
    const viewId = this.connection.viewId;
    if (!frame || viewId === "" || frame.connection !== this.connections) return;
    // The element shows the whole picture, stretched while it has another size than the window.
    const { width, height } = this.screen.size;
    // A pointer on the border of a pixel means the pixel that begins there, whatever the rounding on the way here.
    const x = Math.floor((right * (height / width) + 0.5) * frame.width + 1e-6);
    const y = Math.floor((down + 0.5) * frame.height + 1e-6);
    if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) return;
    const mine = ++this.picking;
    try {
      const answer = await this.services.pick.pick(
        { frame: { case: "view", value: { viewId, sequence: BigInt(frame.sequence) } }, x, y, radiusPx: kPickRadiusPx },
        { timeoutMs: kCallTimeoutMs },
      );
      if (mine === this.picking) this.picked.show(answer.glyph ?? answer.fibre ?? answer.surface ?? null);
    } catch (error) {
      if (mine === this.picking) this.status.message(sentence(error));
    }
  }

  private move(change: (camera: Camera) => Camera): void {
    if (!this.camera) return;
    this.camera = change(this.camera);
    this.connection.change({ camera: toMessage(this.camera), clientTimeMs: performance.now() });
  }

  private async choose(settings: Settings): Promise<void> {
    const former = this.settings;
    const dataset = this.dataset(settings);
    this.settings = settings;
    if (!dataset || !former) return;
    if (former.datasetId !== settings.datasetId) return this.change(former, settings);
    if (needsNewCamera(former, settings)) return this.refit();
    if (former.slice !== settings.slice && this.camera) {
      // The camera stays at the same distance from the slice, so that orbiting goes on about it.
      const range = sliceRange(dataset, settings.plane);
      const by = subtract(slicePosition(dataset, range, settings.slice), slicePosition(dataset, range, former.slice));
      this.camera = shift(this.camera, by);
    }
    this.sendScene();
  }

  /** Goes over to another dataset, or stays with the former if it cannot be read. */
  private async change(former: Settings, settings: Settings): Promise<void> {
    try {
      this.status.message(`Reading ${settings.datasetId}`);
      const dataset = await this.details(settings.datasetId, AbortSignal.timeout(kReadTimeoutMs));
      if (settings !== this.settings) return;
      this.settings = adapt(settings, dataset);
      this.status.message("");
      await this.refit();
    } catch (error) {
      if (settings === this.settings) this.settings = former;
      this.status.message(sentence(error));
    }
    if (this.settings) this.controls.show(this.datasets, this.settings);
  }

  private sendScene(): void {
    const dataset = this.dataset(this.settings);
    if (!dataset || !this.settings || !this.camera) return;
    this.connection.change({
      scene: scene(this.settings, dataset),
      camera: toMessage(this.camera),
      clientTimeMs: performance.now(),
    });
  }

  private async refit(): Promise<void> {
    const mine = ++this.fitting;
    try {
      await this.fitCamera(AbortSignal.timeout(kCallTimeoutMs));
      if (mine === this.fitting) this.sendScene();
    } catch (error) {
      if (mine === this.fitting) this.status.message(sentence(error));
    }
  }

  private async fitCamera(signal: AbortSignal): Promise<void> {
    const settings = this.settings;
    const dataset = this.dataset(settings);
    if (!settings || !dataset) return;
    const { width, height } = this.pixels();
    const aspect = Math.min(Math.max(width / height, 0.05), 20);
    const answer = await this.services.catalog.fitCamera(
      { datasetId: settings.datasetId, selection: selection(settings, dataset), convention: settings.convention, aspect },
      { signal, timeoutMs: kCallTimeoutMs },
    );
    if (!answer.camera) throw new ConnectError("The server answered without a camera.", Code.Internal);
    const camera = fromMessage(answer.camera);
    cameraFrame(camera);
    if (settings === this.settings) this.camera = camera;
  }

  private connectionChanged(state: ConnectionState, reason: string): void {
    this.connectionState = state;
    if (state === "connected") this.connections += 1;
    else this.decoder.reset();
    this.status.connection(state, reason);
  }

  private show(frame: Frame, bitmap: ImageBitmap): void {
    const now = performance.now();
    const isNew = this.shown?.cameraSequence !== Number(frame.cameraSequence) || this.shown.connection !== this.connections;
    this.screen.show(bitmap);
    this.rate.shown(now);
    const sent = frame.timing?.clientTimeMs ?? 0;
    // Later frames of the same camera are finer, not older: the age is that of the first.
    if (isNew && sent > 0) this.ageMs = now - sent;
    if (frame.request) this.echoed = frame;
    this.shown = shownFrame(frame, frame.format === ImageFormat.JPEG ? "jpeg" : "png", this.connections);
    for (const sequence of this.cameras.keys()) {
      if (sequence < frame.cameraSequence) this.cameras.delete(sequence);
    }
    this.status.frame(frame, this.rate.frameMs(), this.ageMs);
  }
}
