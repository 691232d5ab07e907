// Pieces of which the views are made.
import { command_line, run } from "./api.js";

/// An element with attributes (functions are listeners) and children.
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined && value !== null) made.setAttribute(name, value);
  made.append(...children.filter(child => child !== null && child !== undefined));
  return made;
}

/// The same of SVG, without listeners.
export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/// Where a layer over a picture has a mouse event: in the picture's pixels.
export function picture_place(layer, event) {
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(layer.getScreenCTM().inverse());
  return [x, y];
}

/// Chooses a name of a choice(), which is added to it if it is new.
export function choose(select, name) {
  if (![...select.options].some(option => option.value === name)) select.append(element("option", { value: name }, name));
  select.value = name;
}

export function field(words, input) { return element("label", {}, words, input); }

export function choice(names, none) {
  return element("select", {}, element("option", { value: "" }, none), ...names.map(name => element("option", { value: name }, name)));
}

const kEnds = { 0: "Done.", 2: "Refused: see the message.", 3: "A file cannot be read: see the message.",
  4: "No answer: see the message.", 5: "Done, with doubts: see the report.", 6: "A file cannot be written: see the message.",
  130: "Stopped.", 143: "Stopped." };

/// A button that runs a command whose words `words()` gives, shows the command and what it says, and calls `ended` with
/// the words and the exit code. `prepare` is waited for before.
export function command_panel(name, words, ended = () => {}, prepare = async () => {}) {
  const shown = element("code", { class: "command", "aria-label": "The command that does this" });
  const said = element("pre", { hidden: true, "aria-live": "polite" });
  const end = element("p", { role: "status" });
  const control = {};
  const start = element("button", { class: "first", click: begin }, name);
  const stop = element("button", { disabled: true, click: () => control.stop?.() }, "Stop");
  const copy = element("button", { click: () => navigator.clipboard.writeText(shown.textContent) }, "Copy the command");
  const show = () => { shown.textContent = command_line(words()); };

  async function begin() {
    start.disabled = true;
    stop.disabled = false;
    said.hidden = false;
    said.textContent = end.textContent = "";
    end.className = "";
    try {
      await prepare();
      const asked = words();
      const { exit_code } = await run(asked, { control, on_said: text => {
        said.append(text);
        said.scrollTop = said.scrollHeight;
      } });
      end.textContent = kEnds[exit_code] ?? `Ended with exit code ${exit_code}.`;
      if (exit_code !== 0 && exit_code !== 5) end.className = "bad";
      await ended(asked, exit_code);
    } catch (error) {
      end.textContent = error.message;
      end.className = "bad";
    }
    start.disabled = false;
    stop.disabled = true;
  }

  show();
  return { panel: element("section", {}, element("div", { class: "row" }, start, stop, copy), shown, said, end), show };
}

/// A report of a run, and a way to open it by itself.
export function report_frame(file) {
  return element("section", {},
    element("p", {}, element("a", { href: file, target: "_blank", rel: "noopener" }, "Open the report by itself")),
    element("iframe", { src: file, title: "Report", sandbox: "allow-scripts allow-popups" }));
}
