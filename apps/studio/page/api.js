// What the page asks of the studio's server (apps/studio/studio_server.cpp).

async function answer_of(response) {
  const answer = await response.json().catch(() => ({ error: `the studio answers ${response.status}` }));
  if (!response.ok) throw new Error(answer.error ?? `the studio answers ${response.status}`);
  return answer;
}

export const ask = async path => answer_of(await fetch(path));

export const tell = async (path, json) => answer_of(await fetch(path, {
  method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(json) }));

export const upload = async file => answer_of(await fetch(`upload?name=${encodeURIComponent(file.name)}`, {
  method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: file }));

/// The address of a file of the folder.
export const address = name => "file/" + name.split("/").map(encodeURIComponent).join("/");

/// The rows of a table (CSV) of the folder, by their columns' names. Only a last column may hold commas.
export async function table_of(name) {
  const text = await (await fetch(address(name))).text();
  const [head, ...rows] = text.trim().split(/\r?\n/).filter(line => !line.startsWith("#")).map(line => line.split(","));
  return rows.map(row => Object.fromEntries(head.map((column, i) => [column, row[i]])));
}

/// The command line that does the same, to be copied.
export const command_line = words => ["vegard", ...words]
  .map(word => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`).join(" ");

/// Runs a command. `on_said` gets what it says, piece by piece. The promise is of its end: { exit_code, output, job }.
/// `control.stop()` stops it.
export async function run(words, { on_said = () => {}, control = {}, shown = false } = {}) {
  const { job } = await tell("run", { words, shown });
  control.stop = () => tell(`job/${job}/stop`, {});
  for (let from = 0; ;) {
    const state = await ask(`job/${job}?from=${from}`);
    if (state.said) on_said(state.said);
    from = state.end;
    if (!state.runs) return { exit_code: state.exit_code, output: state.output, job };
  }
}
