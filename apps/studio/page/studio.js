// The studio: the files of the folder at the side, one of them in view. The part of the address behind # names it.
import { ask, upload } from "./api.js";
import { element } from "./parts.js";
import { photo_view } from "./photo.js";
import { run_parts } from "./run.js";
import { scene_view } from "./scene.js";

const list = document.getElementById("files"), view = document.getElementById("view"), said = document.getElementById("said");
const kLook_ms = 20000;  // what others put into the folder is seen after so long
let files = [];

const opened = () => decodeURIComponent(location.hash.slice(1));

function say(text, is_bad = false) {
  said.textContent = text;
  said.className = is_bad ? "bad" : "";
}

async function show_files() {
  files = await ask("files");
  const parts = [["photograph", "Photographs"], ["scene", "Scenes and cameras"], ["run", "Runs"]];
  list.replaceChildren(...parts.flatMap(([kind, title]) => {
    const of_kind = files.filter(file => file.kind === kind);
    return of_kind.length === 0 ? [] : [element("h2", {}, title), element("ul", {}, ...of_kind.map(file =>
      element("li", {}, element("a", { href: "#" + encodeURIComponent(file.name), "aria-current": file.name === opened() && "page" }, file.name))))];
  }));
}

function welcome() {
  return element("article", {}, element("h2", {}, "Drop a photograph here"),
    element("p", {}, "It is copied into the folder in which the studio was started. Then choose it at the side: " +
      "vegard says what the file says, measures it when you ask, and shows the report."),
    element("p", {}, "A scene (TOML) opens with its parameters as sliders."));
}

async function show() {
  try {
    await show_files();
    const file = files.find(one => one.name === opened());
    if (opened() && !file) say(`${opened()} is not in the folder`, true);
    const made = !file ? welcome()
      : file.kind === "photograph" ? photo_view(file.name, files, show_files)
        : file.kind === "scene" ? await scene_view(file.name, files, show_files)
          : element("article", {}, element("h2", {}, file.name), await run_parts(file.name));
    if (!file || file.name === opened()) view.replaceChildren(made);
  } catch (error) {
    say(error.message, true);
  }
}

async function take(dropped) {
  for (const file of dropped) {
    say(`${file.name} …`);
    try {
      const { name } = await upload(file);
      say(`${name} is in the folder.`);
      location.hash = encodeURIComponent(name);
    } catch (error) {
      say(error.message, true);
    }
  }
  await show_files();
}

document.getElementById("chosen").addEventListener("change", event => { take(event.target.files); event.target.value = ""; });
for (const name of ["dragover", "dragleave", "drop"])
  document.addEventListener(name, event => {
    event.preventDefault();
    document.body.classList.toggle("over", name === "dragover");
    if (name === "drop") take(event.dataTransfer.files);
  });
setInterval(() => show_files().catch(() => say("The studio has been closed.", true)), kLook_ms);
window.addEventListener("hashchange", () => { say(""); show(); });
show();
