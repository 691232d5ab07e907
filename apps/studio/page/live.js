// The live view of a scene, to fly through: the page that `vegard export --web` writes, in place.
import { command_line, run } from "./api.js";
import { element } from "./parts.js";

/// A panel whose button makes the view of the scene as it is then; `changed_words()` are its changes.
export function live_panel(name, changed_words) {
  const shown = element("code", { class: "command", "aria-label": "The command that writes this view" });
  const status = element("p", { role: "status" }), place = element("div");
  const words = () => ["export", name, ...changed_words()];
  const show = () => { shown.textContent = command_line([...words(), "--web", name.replace(/^.*\//, "").replace(/\.toml$/, "") + ".html"]); };
  const start = element("button", { click: async () => {
    start.disabled = true;
    status.className = "";
    status.textContent = "Making maps and profiles …";
    let said = "";
    try {
      const end = await run(words(), { shown: true, on_said: text => { said += text; } });
      if (end.exit_code !== 0) throw new Error(said.trim());
      status.textContent = said.trim().split("\n").slice(1).join("; ");
      place.replaceChildren(element("iframe", { class: "live", src: `picture/${end.job}`, title: "Live view", sandbox: "allow-scripts" }));
    } catch (error) {
      status.textContent = error.message;
      status.className = "bad";
    }
    start.disabled = false;
  } }, "Fly through it");
  show();
  return { panel: element("section", {}, element("div", { class: "row" }, start), shown, status, place), show };
}
