// Writes the TypeScript of the generated wrappers from their description (describe.mjs).
import { typeName } from "./describe.mjs";

const head = (what) => `// Generated from include/mvs-api.json by tools/generate.mjs. Do not edit.\n// ${what}\n\n`;

function doc(text, indent = "") {
  if (!text) return "";
  const lines = [""];
  for (const word of text.replace(/\*\//g, "* /").split(" ")) {
    const last = lines.length - 1;
    if (lines[last].length + word.length > 96 - indent.length) lines.push(word);
    else lines[last] += (lines[last] ? " " : "") + word;
  }
  if (lines.length === 1) return `${indent}/** ${lines[0]} */\n`;
  return `${indent}/**\n${lines.map((line) => `${indent} * ${line}\n`).join("")}${indent} */\n`;
}

const arrayTypes = { F64: "Float64Array", U32: "Uint32Array", U64: "BigUint64Array", U8: "Uint8Array" };

export function enumsText(api) {
  let text = head("Enumerations: the number of each word, and the words as a type.");
  for (const entry of api.enums) {
    const name = typeName(entry.name);
    text += doc(entry.doc);
    text += `export const ${name} = {\n`;
    for (const value of entry.words) text += doc(value.doc, "  ") + `  ${value.word}: ${value.value},\n`;
    text += "} as const;\n";
    text += `export type ${name} = keyof typeof ${name};\n\n`;
  }
  const kinds = api.enums.find((entry) => entry.name === "mvs_array_kind");
  text += "/** Types of the arrays of a snapshot, by their names. */\nexport interface ArrayTypes {\n";
  for (const { doc: shape, word } of kinds.words) text += doc(shape, "  ") + `  ${word}: ${arrayTypes[shape.match(/^\w+/)[0]]};\n`;
  text += "}\n\n";
  text += "/** All of them by their names in C. */\nexport const enums: Record<string, Record<string, number>> = {\n";
  for (const entry of api.enums) text += `  ${entry.name}: ${typeName(entry.name)},\n`;
  return text + "};\n";
}

const inputs = new Set();
const outputs = new Set();

function mark(api, name, set) {
  if (set.has(name)) return;
  set.add(name);
  const struct = api.structs.find((entry) => entry.name === name);
  for (const field of struct.fields) {
    if (["struct", "structs"].includes(field.codec.kind)) mark(api, field.codec.of, set);
  }
}

function collect(api) {
  for (const fn of api.functions) {
    for (const step of fn.steps) {
      if (step.how === "inStruct" || step.how === "inStructs") mark(api, step.of, inputs);
      if (step.how === "outStruct") mark(api, step.of, outputs);
    }
    if (fn.name === "mvs_last_error") mark(api, "mvs_error", outputs);
  }
  for (const struct of api.structs) if (struct.name.startsWith("mvs_op_") && struct.all[0].of === "mvs_op") mark(api, struct.name, inputs);
}

const inputName = (name) => typeName(name) + (outputs.has(name) ? "Input" : "");

function fieldType(field, input) {
  const { codec } = field;
  switch (codec.kind) {
    case "u64":
      return input ? "bigint | number" : "bigint";
    case "enum":
      return input ? `${typeName(codec.of)} | number` : `${typeName(codec.of)}`;
    case "text":
      return input ? "string | null" : "string";
    case "chars":
      return "string";
    case "array":
      return "ArrayInput";
    case "view":
      return "ArrayView";
    case "struct":
      return (input ? inputName(codec.of) : typeName(codec.of)) + (codec.length ? "[]" : "");
    case "structs":
      return `readonly ${inputName(codec.of)}[]`;
    case "texts":
      return "readonly string[]";
    case "ids":
      return "readonly (bigint | number)[]";
    case "address":
      return "number";
    case "callback":
      return codec.of === "log" ? "LogCallback | null" : "ProgressCallback | null";
    default:
      if (input && codec.flag) return "number | boolean";
      if (!codec.length) return "number";
      return input ? "ArrayLike<number>" : "number[]";
  }
}

function interfaceText(struct, input) {
  let text = doc(struct.doc);
  text += `export interface ${input ? inputName(struct.name) : typeName(struct.name)} {\n`;
  for (const field of struct.fields) {
    text += doc(field.doc, "  ");
    text += `  ${field.name}${input ? "?" : ""}: ${fieldType(field, input)};\n`;
  }
  return text + "}\n\n";
}

// The fields of operations as operations.ts writes them: parts by name, points and vectors as arrays.
function operationFieldType(field) {
  const { codec } = field;
  if (codec.kind === "u64") return "PartRef";
  if (codec.kind === "array") return "ArrayInput";
  if (codec.of === "mvs_site") return "Place";
  if (codec.of === "mvs_point" || codec.length) return "ArrayLike<number>";
  return fieldType({ codec: { ...codec, flag: false } }, true).replace(" | null", "");
}

function operationsText(api) {
  let text = "/** Fields of each operation, by its name, as check() and apply() take them: SI units; those left out take their defaults. */\n";
  text += "export interface OperationValues {\n";
  for (const { word } of api.enums.find((entry) => entry.name === "mvs_op_kind").words) {
    const struct = api.structs.find((entry) => entry.name === `mvs_op_${word}`);
    if (!struct) continue;
    text += doc(struct.doc, "  ") + `  ${word}: {\n`;
    for (const field of struct.fields.filter((one) => one.codec.of !== "mvs_op")) {
      text += doc(field.doc, "    ") + `    ${field.name}?: ${operationFieldType(field)} | null;\n`;
    }
    text += "  };\n";
  }
  return text + "}\n\n";
}

export function structsText(api) {
  collect(api);
  let text = head("Structs: types of their fields (SI units), and their layouts on wasm32.");
  text += 'import type { ArrayInput, ArrayView, LogCallback, ProgressCallback } from "../arrays.js";\n';
  text += 'import type { Layout } from "../layout.js";\n';
  text += 'import type { PartRef, Site as Place } from "../operations.js";\n';
  const used = new Set();
  for (const struct of api.structs) {
    if (["mvs_op", "mvs_array", "mvs_view"].includes(struct.name)) continue;
    for (const field of struct.fields) if (field.codec.kind === "enum") used.add(typeName(field.codec.of));
  }
  text += `import type {\n${[...used].sort().map((name) => `  ${name},\n`).join("")}} from "./enums.js";\n\n`;
  for (const struct of api.structs) {
    if (["mvs_op", "mvs_array", "mvs_view"].includes(struct.name)) continue;
    const shown = { ...struct, fields: struct.fields.filter((field) => field.codec.of !== "mvs_op") };
    if (outputs.has(struct.name)) text += interfaceText(shown, false);
    if (inputs.has(struct.name)) text += interfaceText(shown, true);
  }
  text += operationsText(api);
  text += "export const layouts: Record<string, Layout> = {\n";
  for (const struct of api.structs) {
    text += `  ${struct.name}: {\n    size: ${struct.size},\n    sized: ${struct.sized},\n    fields: [\n`;
    for (const field of struct.fields) {
      text += `      ${JSON.stringify({ name: field.name, ...field.codec }).replace(/"(\w+)":/g, "$1: ").replace(/,(?=\w)/g, ", ").replace(/^\{/, "{ ").replace(/\}$/, " }")},\n`;
    }
    text += "    ],\n  },\n";
  }
  return text + "};\n";
}

const handleType = (name) => typeName(name) + "Handle";

function parameterType(step) {
  switch (step.how) {
    case "handle":
      return handleType(step.of);
    case "inStruct":
      return inputName(step.of);
    case "inStructs":
      return `readonly ${inputName(step.of)}[]`;
    case "operation":
      return "Operation";
    case "bytes":
      return "Uint8Array | string";
    case "callback":
      return "FaultCallback";
    case "text":
      return "string";
    case "inArray":
      return "ArrayLike<number>";
    case "enum":
      return `${typeName(step.of)} | number`;
    case "scalar":
      return step.element === "u64" ? "bigint | number" : "number";
    default:
      return undefined;
  }
}

function outputType(step) {
  switch (step.how) {
    case "outHandle":
      return handleType(step.of);
    case "outStruct":
      return typeName(step.of);
    case "outView":
      return "ArrayView";
    case "outArray":
      return step.element === "u64" ? "bigint[]" : "number[]";
    case "outScalar":
      return step.element === "u64" ? "bigint" : "number";
    case "outText":
      return "string";
    case "fill":
      return step.element === "U8" ? "Uint8Array" : "Float64Array";
    default:
      return undefined;
  }
}

function returnType(fn, outs) {
  if (outs.length === 1) return outputType(outs[0]);
  if (outs.length > 1) return `{ ${outs.map((out) => `${out.name}: ${outputType(out)}`).join("; ")} }`;
  if (fn.returns === "const char *") return "string";
  if (fn.returns === "const mvs_error *") return "Error_";
  if (fn.returns === "code") return "number";
  return fn.returns === "uint32_t" ? "number" : "void";
}

function functionText(fn) {
  const ins = fn.steps.filter((step) => parameterType(step));
  const outs = fn.steps.filter((step) => outputType(step));
  // optional parameters at the end may be left out
  let optional = true;
  const parameters = [...ins].reverse().map((step) => {
    optional &&= step.nullable && step.how !== "handle";
    const type = parameterType(step) + (step.nullable ? " | null" : "");
    return `${step.name}${optional ? "?" : ""}: ${type}`;
  }).reverse();
  let text = doc(fn.doc, "  ");
  text += `  ${fn.name}(${parameters.join(", ")}): ${returnType(fn, outs)} {\n`;
  text += `    return this.invoke(signatures.${fn.name}!, [${ins.map((step) => step.name).join(", ")}]) as never;\n  }\n`;
  return text;
}

export function functionsText(api) {
  let text = head("Functions of the C interface: failures are exceptions, outputs are results.");
  text += 'import type { ArrayView, FaultCallback } from "../arrays.js";\n';
  text += 'import { Calls, type Operation, type Signature } from "../calls.js";\n';
  const body = api.functions.map((fn) => functionText(fn)).join("\n");
  const names = (list) => [...new Set(list)].filter((name) => new RegExp(`\\b${name}\\b`).test(body.replace(/\/\*\*.*?\*\//gs, ""))).sort();
  const enumNames = names(api.enums.map((entry) => typeName(entry.name)));
  const structNames = names(api.structs.flatMap((s) => [typeName(s.name), inputName(s.name)])).filter((n) => n !== "Error");
  text += `import type {\n${enumNames.map((n) => `  ${n},\n`).join("")}} from "./enums.js";\n`;
  text += `import type {\n  Error as Error_,\n${structNames.map((n) => `  ${n},\n`).join("")}} from "./structs.js";\n\n`;
  const handles = [...new Set(api.functions.flatMap((fn) => fn.steps.filter((s) => s.of && /andle/.test(s.how)).map((s) => s.of)))];
  for (const name of handles) {
    text += `/** The address of a ${name}. */\nexport type ${handleType(name)} = number & { readonly of?: "${name}" };\n`;
  }
  text += "\nconst signatures: Record<string, Signature> = {\n";
  for (const fn of api.functions) {
    const steps = fn.steps.map((step) => `      ${JSON.stringify(step).replace(/"(\w+)":/g, "$1: ").replace(/,(?=\w)/g, ", ").replace(/^\{/, "{ ").replace(/\}$/, " }")},\n`);
    text += `  ${fn.name}: {\n    name: "${fn.name}",\n    returns: "${fn.returns}",\n    steps: [${steps.length ? `\n${steps.join("")}    ` : ""}],\n  },\n`;
  }
  text += "};\n\n";
  text += "/** The functions under their names in C. Handles are addresses, which the caller releases. */\n";
  text += `export class Functions extends Calls {\n${body}}\n`;
  return text;
}
