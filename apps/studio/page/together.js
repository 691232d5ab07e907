// Further photographs of the same aurora, from elsewhere, to be measured together with the one in view: what is known of each.
import { choice, element, field } from "./parts.js";

/// What is asked of each photograph, by the option of the command.
export function known_inputs(scenes, photographs) {
  return {
    "--time": element("input", { placeholder: "of the file; else 2014-02-21T19:30:40Z" }),
    "--site": element("input", { placeholder: "of the file; else latitude,longitude,metres" }),
    "--camera": choice(scenes, "by the stars or the skyline"),
    "--mask": choice(photographs, "found by itself"),
  };
}

export const known_fields = known => [field("Time (UTC or with a zone)", known["--time"]), field("Place of the camera", known["--site"]),
  field("Camera, if it is known", known["--camera"]), field("Mask: white is sky", known["--mask"])];

/// A choice of one more photograph; when that is made, fields for it and a choice of the next.
export function together_fields(scenes, photographs) {
  const panel = element("div"), all = [];
  function add() {
    const photo = choice(photographs, "none"), known = known_inputs(scenes, photographs);
    const fields = element("div", { class: "fields", hidden: true }, ...known_fields(known));
    photo.addEventListener("input", () => {
      fields.hidden = !photo.value;
      if (all.every(one => one.photo.value) && all.length < photographs.length) add();
    });
    all.push({ photo, known });
    panel.append(element("div", { class: "fields" }, field("The same aurora from elsewhere", photo)), fields);
  }
  add();
  return { panel, chosen: () => all.filter(one => one.photo.value) };
}
