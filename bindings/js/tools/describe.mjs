// Turns the description of the C interface (mvs-api.json) into that of its wrappers: layouts of
// structs on wasm32, kinds of fields and parameters.

const scalars = { uint8_t: ["u8", 1], uint32_t: ["u32", 4], int32_t: ["i32", 4], uint64_t: ["u64", 8],
  double: ["f64", 8], char: ["char", 1] };
// Arrays of the caller whose number of components no comment states.
const components = { "mvs_surface_desc.closed_points": 3, "mvs_surface_desc.closed_triangles": 3 };

const camel = (text) => text.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
// mvs_settle_options -> SettleOptions
export const typeName = (name) => camel(`_${name.replace(/^mvs_/, "")}`);

// Numbers without a stated default that C replaces by one where they are 0, and others where 0 has its own meaning.
const withDefault = (struct, field) => struct === "mvs_parametric_desc" && field.kind === "f64";
const zeroCounts = new Set(["mvs_body_desc.radius"]);

// Says how C takes a 0 in a field: "default" in its place, "explicit" the default with the explicit solver only, undefined as 0.
function meaningOfZero(struct, field) {
  if (!["f64", "u32"].includes(field.kind) || field.length || zeroCounts.has(`${struct}.${field.name}`)) return undefined;
  const stated = field.default ?? "";
  if (/explicit 500|500 explicit/.test(stated)) return "explicit";
  return withDefault(struct, field) || (stated && !/^0\b(?![.])/.test(stated)) ? "default" : undefined;
}

// The words of an enumeration: its values without their common prefix, in lower case.
function words(entry) {
  const names = entry.values.map((value) => value.name);
  const family = `MVS_${entry.name.replace(/^mvs_/, "").replace(/_flags$/, "").toUpperCase()}_`;
  let prefix = family;
  while (!names.every((name) => name.startsWith(prefix))) {
    prefix = prefix.slice(0, prefix.lastIndexOf("_", prefix.length - 2) + 1);
  }
  return entry.values.map((value) => ({ ...value, word: value.name.slice(prefix.length).toLowerCase() }));
}

class Describer {
  constructor(api) {
    this.enums = api.enums.filter((entry) => entry.values.length > 0)
      .map((entry) => ({ ...entry, words: words(entry), type: entry.type ?? "uint32_t" }));
    this.byName = new Map(this.enums.map((entry) => [entry.name, entry]));
    for (const entry of api.enums) if (!this.byName.has(entry.name)) scalars[entry.name] ??= scalars[entry.type];
    this.structs = new Map();
  }

  // Kind, size and alignment of a field.
  kind(field) {
    const { type } = field;
    if (type === "callback") return { kind: "callback", size: 4, align: 4 };
    if (type === "void *") return { kind: "user", size: 4, align: 4 };
    if (type.endsWith("*") || type.endsWith("*const")) return { kind: "pointer", size: 4, align: 4 };
    if (this.byName.has(type)) return { kind: "enum", of: type, size: 4, align: 4 };
    if (scalars[type]) return { kind: scalars[type][0], size: scalars[type][1], align: scalars[type][1] };
    const struct = this.structs.get(type);
    if (!struct) throw new Error(`unknown type ${type}`);
    return { kind: "struct", of: type, size: struct.size, align: struct.align };
  }

  struct(entry) {
    let offset = 0;
    let align = 1;
    const all = entry.fields.map((field) => {
      const kind = this.kind(field);
      offset = Math.ceil(offset / kind.align) * kind.align;
      const placed = { ...field, ...kind, offset };
      offset += kind.size * (field.length ?? 1);
      align = Math.max(align, kind.align);
      return placed;
    });
    const made = { ...entry, all, size: Math.ceil(offset / align) * align, align };
    made.fields = this.visible(made);
    this.structs.set(entry.name, made);
    return made;
  }

  // The fields that a caller sees, with the codec of each.
  visible(struct) {
    const names = new Set(struct.all.map((field) => field.name));
    // WebAssembly has no threads
    const hidden = new Set(["struct_size", "reserved", "workers", "pool_width", "run_tasks"]);
    const shown = [];
    for (const field of struct.all) {
      const one = field.name.replace(/ies$/, "y").replace(/s$/, "");
      const codec = this.codec(struct, field, names, one);
      if (codec.kind === "structs") [`${one}_count`, `${one}_stride`].forEach((name) => hidden.add(name));
      if (field.name === "scallops") hidden.add("scallop_count");
      if (codec.kind === "user") hidden.add(field.name);
      const zero = meaningOfZero(struct.name, field);
      if (zero) codec.zero = zero;
      if (codec.kind === "u32" && !field.length && /^1: /.test(field.doc ?? "")) codec.flag = true;
      shown.push({ ...field, codec });
    }
    return shown.filter((field) => !hidden.has(field.name));
  }

  codec(struct, field, names, one) {
    const at = field.offset;
    const full = `${struct.name}.${field.name}`;
    const offsetOf = (name) => struct.all.find((other) => other.name === name)?.offset;
    if (field.kind === "pointer") {
      if (field.type === "const char *") return { kind: "text", at };
      const pointed = field.type.match(/^const (mvs_\w+) \*$/)?.[1];
      if (pointed && this.structs.has(pointed) && names.has(`${one}_stride`)) {
        return { kind: "structs", of: pointed, at, count: offsetOf(`${one}_count`), stride: offsetOf(`${one}_stride`) };
      }
      if (field.name === "scallops") return { kind: "texts", at, count: offsetOf("scallop_count") };
      if (field.type === "const mvs_id *") return { kind: "ids", at };
      if (field.type === "const void *") return { kind: "address", at };
      throw new Error(`no codec for ${full}: ${field.type}`);
    }
    if (field.kind === "struct" && field.of === "mvs_array") {
      const wide = field.doc?.match(/\bx (\d)\b/)?.[1] ?? components[full] ?? 1;
      const element = field.doc?.match(/^(U32|U64|F64|U8)/)?.[1] ?? "F64";
      return { kind: "array", at, components: Number(wide), element };
    }
    if (field.kind === "struct" && field.of === "mvs_view") return { kind: "view", at };
    if (field.kind === "struct") return { kind: "struct", of: field.of, at, length: field.length };
    if (field.kind === "char") return { kind: "chars", at, length: field.length };
    if (field.kind === "enum" && this.byName.get(field.of).type === "int32_t") return { kind: "i32", at };
    if (field.kind === "enum") return { kind: this.byName.get(field.of).flags ? "u32" : "enum", of: field.of, at };
    if (field.kind === "callback" || field.kind === "user") {
      return { kind: field.kind, of: field.name, at, user: offsetOf("user") };
    }
    return { kind: field.kind, at, length: field.length };
  }
}

// Functions whose code is their answer, not a failure.
const returnsCode = new Set(["mvs_check_valve"]);

// The steps of a wrapper, one for one or more parameters of its function.
function steps(fn, describer) {
  const list = fn.parameters;
  const made = [];
  for (let k = 0; k < list.length; ++k) {
    const p = list[k];
    const next = list[k + 1];
    const base = p.type.replace(/^const /, "").replace(/ \*+$/, "");
    const row = { name: p.name, nullable: Boolean(p.nullable) };
    if (next?.name === "capacity") {
      made.push({ ...row, how: "fill", element: base === "void" ? "U8" : "F64", components: base === "void" ? 1 : 3 });
      k += 2;
    } else if (p.name === "data" && next?.name === "size") {
      made.push({ ...row, how: "bytes" });
      k += 1;
    } else if (p.type.endsWith("_fn") && next?.name === "user") {
      made.push({ ...row, how: "callback", of: "fault" });
      k += 1;
    } else if (p.type === "const char *") {
      made.push({ ...row, how: "text" });
    } else if (p.type === "const char **") {
      made.push({ ...row, how: "outText" });
    } else if (p.type.endsWith("**")) {
      if (!fn.result_freed_by) throw new Error(`${fn.name}: its documentation does not say what releases ${p.name}`);
      made.push({ ...row, how: "outHandle", of: base, freedBy: fn.result_freed_by });
    } else if (p.type.endsWith("*") && describer.handles.has(base)) {
      made.push({ ...row, how: "handle", of: base });
    } else if (p.type.endsWith("*") && base === "mvs_op") {
      made.push({ ...row, how: "operation" });
    } else if (p.type.endsWith("*") && describer.structs.has(base) && /_count$/.test(next?.name) && /_stride$/.test(list[k + 2]?.name)) {
      made.push({ ...row, how: "inStructs", of: base });
      k += 2;
    } else if (p.type.endsWith("*") && describer.structs.has(base)) {
      made.push({ ...row, how: p.type.startsWith("const") ? "inStruct" : base === "mvs_view" ? "outView" : "outStruct", of: base });
    } else if (p.length) {
      const element = scalars[base][0];
      made.push({ ...row, how: p.type.startsWith("const") ? "inArray" : "outArray", element, length: p.length });
    } else if (p.type.endsWith("*")) {
      made.push({ ...row, how: "outScalar", element: scalars[base]?.[0] ?? "u32" });
    } else {
      made.push({ ...row, how: describer.byName.has(p.type) && !describer.byName.get(p.type).flags ? "enum" : "scalar",
        of: p.type, element: scalars[describer.byName.get(p.type)?.type ?? p.type][0] });
    }
    if (p.direction === "in" && /[\[*]/.test(p.type) === false && p.length === undefined) throw new Error(fn.name);
  }
  return made;
}

// Describes all functions but those that `unwrapped` lists with a reason.
export function describe(api, unwrapped) {
  const describer = new Describer(api);
  describer.handles = new Set(api.handles.map((handle) => handle.name));
  const outside = new Set(["mvs/driver.h", "mvs/device.h"]);
  const structs = api.structs.filter((entry) => !outside.has(entry.header)).map((entry) => describer.struct(entry));
  const unknown = Object.keys(unwrapped).filter((name) => !api.functions.some((f) => f.name === name));
  if (unknown.length > 0) throw new Error(`unwrapped.json names no functions: ${unknown.join(", ")}`);
  const functions = api.functions.filter((fn) => !(fn.name in unwrapped))
    .map((fn) => ({ ...fn, steps: steps(fn, describer), returns: returnsCode.has(fn.name) ? "code" : fn.returns }));
  return { structs, functions, unwrapped: Object.keys(unwrapped), describer,
    enums: describer.enums.filter((entry) => !outside.has(entry.header)), version: api.version };
}
