// Starts the page.
import "./style.css";
import { App } from "./app";
import { PickPanel } from "./pick/panel";
import { connectServices } from "./service";
import { StatusLine } from "./status/line";

function find<T extends HTMLElement>(id: string, type: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`The page has no ${type.name} named ${id}.`);
  return found;
}

const status = new StatusLine({
  frame: find("status-frame", HTMLElement),
  render: find("status-render", HTMLElement),
  age: find("status-age", HTMLElement),
  state: find("status-state", HTMLElement),
  connection: find("status-connection", HTMLElement),
  message: find("message", HTMLElement),
});
const picked = new PickPanel(find("picked", HTMLElement));
const app = new App(connectServices(globalThis.location.origin), status, find("picture", HTMLCanvasElement), picked);
// On a narrow window the controls would hide the picture.
if (globalThis.innerWidth < 720) find("panel", HTMLDetailsElement).open = false;
void app.run();
