// Exports of every entry of the package, besides loadMvs.
export { ArrayView } from "./arrays.js";
export type { ArrayInput, FaultCallback, LogCallback, ProgressCallback, ReadonlyArrayOf, TypedArray } from "./arrays.js";
export { Ensemble } from "./ensemble.js";
export { MvsError } from "./error.js";
export * from "./generated/enums.js";
export { Functions } from "./generated/functions.js";
export type * from "./generated/functions.js";
export type * as structs from "./generated/structs.js";
export { instantiate, Mvs } from "./library.js";
export type { Fault, LoadOptions } from "./library.js";
export type { OperationField, OperationFields, OperationInfo, PartRef, Site } from "./operations.js";
export { packBytes, unpackBytes } from "./pack.js";
export type { Picked, Ray } from "./pick.js";
export { DIASTOLE_PA, Simulator, SYSTOLE_PA } from "./simulator.js";
export type { Finding, SimulatorOptions, SliceOptions } from "./simulator.js";
export { Snapshot } from "./snapshot.js";
export type { ArrayName, History } from "./snapshot.js";
export type { Surface } from "./surface.js";
