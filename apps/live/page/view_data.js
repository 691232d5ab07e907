// The scene as the program has written it (apps/live/live_page.cpp): tables of 16 bits between two numbers, packed.

async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/// A table's numbers: floats as they are, or whole numbers of 16 bits from `low` to `high`.
async function numbers(table) {
  const bytes = await unpack(table.packed);
  if (table.low === undefined) return new Float32Array(bytes);
  const step = (table.high - table.low) / 65535;
  return Float32Array.from(new Uint16Array(bytes), whole => table.low + whole * step);
}

/// Replaces every table by its numbers, at any depth.
export async function decoded(part) {
  if (Array.isArray(part)) return Promise.all(part.map(decoded));
  if (part === null || typeof part !== "object") return part;
  if (part.packed !== undefined) return numbers(part);
  return Object.fromEntries(await Promise.all(Object.entries(part).map(async ([key, value]) => [key, await decoded(value)])));
}
