// Generated from include/mvs-api.json by tools/generate.mjs. Do not edit.
// Functions of the C interface: failures are exceptions, outputs are results.

import type { ArrayView, FaultCallback } from "../arrays.js";
import { Calls, type Operation, type Signature } from "../calls.js";
import type {
  ArrayKind,
  ChordKind,
  EnsembleArray,
  EnsembleStatistic,
  Format,
  PartKind,
  Result,
  SensitivityArray,
  Struct,
} from "./enums.js";
import type {
  Error as Error_,
  BuildOptions,
  ChordInfo,
  CoarsenOptions,
  Coarsening,
  Comparison,
  Cost,
  CostOptions,
  EnsembleMember,
  EnsembleOptions,
  EnsembleSummary,
  FieldInfo,
  Finding,
  History,
  HistoryEntry,
  Law,
  LeafletDesc,
  LeakErrors,
  LoadCase,
  LoadCaseInput,
  Measures,
  OpInfo,
  OrificePart,
  Parameter,
  ParametricDesc,
  Part,
  PlanOptions,
  Profile,
  Quantity,
  RegionMeasures,
  Replay,
  Rest,
  SensitivityOptions,
  SensitivitySummary,
  SettleOptions,
  SimDesc,
  Stability,
  Stats,
  StepOptions,
  SurfaceArray,
  SurfaceDesc,
  SurfaceFileInfo,
  SurfaceFileOptions,
  ToolBody,
  ToolDesc,
  ToolState,
  ValveDesc,
} from "./structs.js";

/** The address of a mvs_sim. */
export type SimHandle = number & { readonly of?: "mvs_sim" };
/** The address of a mvs_snapshot. */
export type SnapshotHandle = number & { readonly of?: "mvs_snapshot" };
/** The address of a mvs_ensemble. */
export type EnsembleHandle = number & { readonly of?: "mvs_ensemble" };
/** The address of a mvs_sensitivity. */
export type SensitivityHandle = number & { readonly of?: "mvs_sensitivity" };
/** The address of a mvs_surface_file. */
export type SurfaceFileHandle = number & { readonly of?: "mvs_surface_file" };
/** The address of a mvs_findings. */
export type FindingsHandle = number & { readonly of?: "mvs_findings" };

const signatures: Record<string, Signature> = {
  mvs_last_error: {
    name: "mvs_last_error",
    returns: "const mvs_error *",
    steps: [],
  },
  mvs_result_name: {
    name: "mvs_result_name",
    returns: "const char *",
    steps: [
      { name: "code", nullable: false, how: "enum", of: "mvs_result", element: "i32" },
    ],
  },
  mvs_version: {
    name: "mvs_version",
    returns: "uint32_t",
    steps: [],
  },
  mvs_features: {
    name: "mvs_features",
    returns: "const char *",
    steps: [],
  },
  mvs_get_field_count: {
    name: "mvs_get_field_count",
    returns: "uint32_t",
    steps: [
      { name: "which", nullable: false, how: "enum", of: "mvs_struct", element: "u32" },
    ],
  },
  mvs_get_field: {
    name: "mvs_get_field",
    returns: "mvs_result",
    steps: [
      { name: "which", nullable: false, how: "enum", of: "mvs_struct", element: "u32" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "field", nullable: false, how: "outStruct", of: "mvs_field_info" },
    ],
  },
  mvs_get_leaflet_law_count: {
    name: "mvs_get_leaflet_law_count",
    returns: "uint32_t",
    steps: [],
  },
  mvs_get_leaflet_law: {
    name: "mvs_get_leaflet_law",
    returns: "mvs_result",
    steps: [
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "law", nullable: false, how: "outStruct", of: "mvs_law" },
    ],
  },
  mvs_get_chord_law_count: {
    name: "mvs_get_chord_law_count",
    returns: "uint32_t",
    steps: [],
  },
  mvs_get_chord_law: {
    name: "mvs_get_chord_law",
    returns: "mvs_result",
    steps: [
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "law", nullable: false, how: "outStruct", of: "mvs_law" },
    ],
  },
  mvs_create: {
    name: "mvs_create",
    returns: "mvs_result",
    steps: [
      { name: "desc", nullable: true, how: "inStruct", of: "mvs_sim_desc" },
      { name: "sim", nullable: false, how: "outHandle", of: "mvs_sim", freedBy: "mvs_destroy" },
    ],
  },
  mvs_destroy: {
    name: "mvs_destroy",
    returns: "void",
    steps: [
      { name: "sim", nullable: true, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_set_valve: {
    name: "mvs_set_valve",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "valve", nullable: false, how: "inStruct", of: "mvs_valve_desc" },
    ],
  },
  mvs_generate_valve: {
    name: "mvs_generate_valve",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "desc", nullable: true, how: "inStruct", of: "mvs_parametric_desc" },
    ],
  },
  mvs_check_valve: {
    name: "mvs_check_valve",
    returns: "code",
    steps: [
      { name: "valve", nullable: false, how: "inStruct", of: "mvs_valve_desc" },
      { name: "fault", nullable: false, how: "callback", of: "fault" },
    ],
  },
  mvs_set_leaflet: {
    name: "mvs_set_leaflet",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "leaflet", nullable: false, how: "scalar", of: "mvs_id", element: "u64" },
      { name: "tissue", nullable: false, how: "inStruct", of: "mvs_leaflet_desc" },
    ],
  },
  mvs_set_load: {
    name: "mvs_set_load",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "load", nullable: false, how: "inStruct", of: "mvs_load_case" },
    ],
  },
  mvs_get_load: {
    name: "mvs_get_load",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "load", nullable: false, how: "outStruct", of: "mvs_load_case" },
    ],
  },
  mvs_settle: {
    name: "mvs_settle",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_settle_options" },
      { name: "stats", nullable: true, how: "outStruct", of: "mvs_stats" },
    ],
  },
  mvs_begin_settle: {
    name: "mvs_begin_settle",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_settle_options" },
    ],
  },
  mvs_advance_settle: {
    name: "mvs_advance_settle",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "seconds", nullable: false, how: "scalar", of: "double", element: "f64" },
      { name: "share", nullable: true, how: "outScalar", element: "f64" },
      { name: "stats", nullable: true, how: "outStruct", of: "mvs_stats" },
    ],
  },
  mvs_cancel_settle: {
    name: "mvs_cancel_settle",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_step: {
    name: "mvs_step",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_step_options" },
    ],
  },
  mvs_prepare_step: {
    name: "mvs_prepare_step",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_step_options" },
    ],
  },
  mvs_get_stats: {
    name: "mvs_get_stats",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "stats", nullable: false, how: "outStruct", of: "mvs_stats" },
    ],
  },
  mvs_get_snapshot: {
    name: "mvs_get_snapshot",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "snapshot", nullable: false, how: "outHandle", of: "mvs_snapshot", freedBy: "mvs_snapshot_release" },
    ],
  },
  mvs_snapshot_retain: {
    name: "mvs_snapshot_retain",
    returns: "void",
    steps: [
      { name: "snapshot", nullable: true, how: "handle", of: "mvs_snapshot" },
    ],
  },
  mvs_snapshot_release: {
    name: "mvs_snapshot_release",
    returns: "void",
    steps: [
      { name: "snapshot", nullable: true, how: "handle", of: "mvs_snapshot" },
    ],
  },
  mvs_restore: {
    name: "mvs_restore",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
    ],
  },
  mvs_snapshot_get_hash: {
    name: "mvs_snapshot_get_hash",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "hash", nullable: false, how: "outArray", element: "u64", length: 2 },
    ],
  },
  mvs_snapshot_get_array: {
    name: "mvs_snapshot_get_array",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "which", nullable: false, how: "enum", of: "mvs_array_kind", element: "u32" },
      { name: "view", nullable: false, how: "outView", of: "mvs_view" },
    ],
  },
  mvs_snapshot_get_part_count: {
    name: "mvs_snapshot_get_part_count",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "kind", nullable: false, how: "enum", of: "mvs_part_kind", element: "u32" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_snapshot_get_part: {
    name: "mvs_snapshot_get_part",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "kind", nullable: false, how: "enum", of: "mvs_part_kind", element: "u32" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "part", nullable: false, how: "outStruct", of: "mvs_part" },
    ],
  },
  mvs_snapshot_find_part: {
    name: "mvs_snapshot_find_part",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "kind", nullable: false, how: "enum", of: "mvs_part_kind", element: "u32" },
      { name: "name", nullable: false, how: "text" },
      { name: "part", nullable: false, how: "outStruct", of: "mvs_part" },
    ],
  },
  mvs_snapshot_get_chord: {
    name: "mvs_snapshot_get_chord",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "chord", nullable: false, how: "outStruct", of: "mvs_chord_info" },
    ],
  },
  mvs_snapshot_get_name: {
    name: "mvs_snapshot_get_name",
    returns: "const char *",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
    ],
  },
  mvs_snapshot_get_load: {
    name: "mvs_snapshot_get_load",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "load", nullable: false, how: "outStruct", of: "mvs_load_case" },
    ],
  },
  mvs_snapshot_get_rest: {
    name: "mvs_snapshot_get_rest",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "rest", nullable: false, how: "outStruct", of: "mvs_rest" },
    ],
  },
  mvs_snapshot_get_stability: {
    name: "mvs_snapshot_get_stability",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "stability", nullable: false, how: "outStruct", of: "mvs_stability" },
    ],
  },
  mvs_snapshot_get_region_count: {
    name: "mvs_snapshot_get_region_count",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_snapshot_get_region: {
    name: "mvs_snapshot_get_region",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "region", nullable: false, how: "outStruct", of: "mvs_region_measures" },
    ],
  },
  mvs_snapshot_get_orifice_part_count: {
    name: "mvs_snapshot_get_orifice_part_count",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_snapshot_get_orifice_part: {
    name: "mvs_snapshot_get_orifice_part",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "part", nullable: false, how: "outStruct", of: "mvs_orifice_part" },
    ],
  },
  mvs_get_chord_limits: {
    name: "mvs_get_chord_limits",
    returns: "mvs_result",
    steps: [
      { name: "kind", nullable: false, how: "enum", of: "mvs_chord_kind", element: "u32" },
      { name: "strain", nullable: false, how: "outScalar", element: "f64" },
      { name: "tension", nullable: false, how: "outScalar", element: "f64" },
    ],
  },
  mvs_snapshot_measure: {
    name: "mvs_snapshot_measure",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "measures", nullable: false, how: "outStruct", of: "mvs_measures" },
    ],
  },
  mvs_snapshot_measure_groups: {
    name: "mvs_snapshot_measure_groups",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "groups", nullable: false, how: "scalar", of: "mvs_measure_group_flags", element: "u32" },
      { name: "measures", nullable: false, how: "outStruct", of: "mvs_measures" },
    ],
  },
  mvs_snapshot_compare: {
    name: "mvs_snapshot_compare",
    returns: "mvs_result",
    steps: [
      { name: "a", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "b", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "comparison", nullable: false, how: "outStruct", of: "mvs_comparison" },
    ],
  },
  mvs_snapshot_section: {
    name: "mvs_snapshot_section",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "point", nullable: false, how: "inArray", element: "f64", length: 3 },
      { name: "normal", nullable: false, how: "inArray", element: "f64", length: 3 },
      { name: "points", nullable: true, how: "fill", element: "F64", components: 3 },
    ],
  },
  mvs_snapshot_get_frame: {
    name: "mvs_snapshot_get_frame",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "frame", nullable: false, how: "outArray", element: "f64", length: 12 },
    ],
  },
  mvs_snapshot_measure_cost: {
    name: "mvs_snapshot_measure_cost",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_cost_options" },
      { name: "cost", nullable: false, how: "outStruct", of: "mvs_cost" },
      { name: "opened", nullable: true, how: "outHandle", of: "mvs_snapshot", freedBy: "mvs_snapshot_release" },
    ],
  },
  mvs_check_op: {
    name: "mvs_check_op",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "op", nullable: false, how: "operation" },
    ],
  },
  mvs_apply_op: {
    name: "mvs_apply_op",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "op", nullable: false, how: "operation" },
      { name: "made", nullable: true, how: "outScalar", element: "u64" },
    ],
  },
  mvs_undo: {
    name: "mvs_undo",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_redo: {
    name: "mvs_redo",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_begin_group: {
    name: "mvs_begin_group",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "name", nullable: false, how: "text" },
    ],
  },
  mvs_end_group: {
    name: "mvs_end_group",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_set_checkpoint: {
    name: "mvs_set_checkpoint",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "name", nullable: false, how: "text" },
    ],
  },
  mvs_restore_checkpoint: {
    name: "mvs_restore_checkpoint",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "name", nullable: false, how: "text" },
    ],
  },
  mvs_snapshot_get_history: {
    name: "mvs_snapshot_get_history",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "history", nullable: false, how: "outStruct", of: "mvs_history" },
    ],
  },
  mvs_snapshot_get_history_entry: {
    name: "mvs_snapshot_get_history_entry",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "entry", nullable: false, how: "outStruct", of: "mvs_history_entry" },
    ],
  },
  mvs_snapshot_get_checkpoint: {
    name: "mvs_snapshot_get_checkpoint",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "name", nullable: false, how: "outText" },
    ],
  },
  mvs_get_op_count: {
    name: "mvs_get_op_count",
    returns: "uint32_t",
    steps: [],
  },
  mvs_get_op_info: {
    name: "mvs_get_op_info",
    returns: "mvs_result",
    steps: [
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "info", nullable: false, how: "outStruct", of: "mvs_op_info" },
    ],
  },
  mvs_get_op_field: {
    name: "mvs_get_op_field",
    returns: "mvs_result",
    steps: [
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "field", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "info", nullable: false, how: "outStruct", of: "mvs_field_info" },
    ],
  },
  mvs_write_plan: {
    name: "mvs_write_plan",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_plan_options" },
      { name: "data", nullable: true, how: "fill", element: "U8", components: 1 },
    ],
  },
  mvs_replay_plan: {
    name: "mvs_replay_plan",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "data", nullable: false, how: "bytes" },
      { name: "replay", nullable: true, how: "outStruct", of: "mvs_replay" },
    ],
  },
  mvs_check_plan: {
    name: "mvs_check_plan",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: true, how: "handle", of: "mvs_sim" },
      { name: "data", nullable: false, how: "bytes" },
      { name: "replay", nullable: true, how: "outStruct", of: "mvs_replay" },
    ],
  },
  mvs_add_tool: {
    name: "mvs_add_tool",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "desc", nullable: false, how: "inStruct", of: "mvs_tool_desc" },
      { name: "tool", nullable: false, how: "outScalar", element: "u64" },
    ],
  },
  mvs_move_tool: {
    name: "mvs_move_tool",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "tool", nullable: false, how: "scalar", of: "mvs_id", element: "u64" },
      { name: "position", nullable: false, how: "inArray", element: "f64", length: 3 },
      { name: "axis", nullable: true, how: "inArray", element: "f64", length: 3 },
    ],
  },
  mvs_move_tool_pose: {
    name: "mvs_move_tool_pose",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "tool", nullable: false, how: "scalar", of: "mvs_id", element: "u64" },
      { name: "position", nullable: false, how: "inArray", element: "f64", length: 3 },
      { name: "orientation", nullable: true, how: "inArray", element: "f64", length: 4 },
    ],
  },
  mvs_remove_tool: {
    name: "mvs_remove_tool",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "tool", nullable: false, how: "scalar", of: "mvs_id", element: "u64" },
    ],
  },
  mvs_get_tool: {
    name: "mvs_get_tool",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "tool", nullable: false, how: "scalar", of: "mvs_id", element: "u64" },
      { name: "state", nullable: false, how: "outStruct", of: "mvs_tool_state" },
    ],
  },
  mvs_snapshot_get_tool_count: {
    name: "mvs_snapshot_get_tool_count",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_snapshot_get_tool: {
    name: "mvs_snapshot_get_tool",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "state", nullable: false, how: "outStruct", of: "mvs_tool_state" },
    ],
  },
  mvs_snapshot_get_tool_body: {
    name: "mvs_snapshot_get_tool_body",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "body", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "out", nullable: false, how: "outStruct", of: "mvs_tool_body" },
    ],
  },
  mvs_load_memory: {
    name: "mvs_load_memory",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "data", nullable: false, how: "bytes" },
      { name: "format", nullable: false, how: "enum", of: "mvs_format", element: "u32" },
    ],
  },
  mvs_save_memory: {
    name: "mvs_save_memory",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "format", nullable: false, how: "enum", of: "mvs_format", element: "u32" },
      { name: "data", nullable: true, how: "fill", element: "U8", components: 1 },
    ],
  },
  mvs_get_profile: {
    name: "mvs_get_profile",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "profile", nullable: false, how: "outStruct", of: "mvs_profile" },
    ],
  },
  mvs_refine_valve: {
    name: "mvs_refine_valve",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
    ],
  },
  mvs_coarsen_valve: {
    name: "mvs_coarsen_valve",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "options", nullable: false, how: "inStruct", of: "mvs_coarsen_options" },
      { name: "made", nullable: true, how: "outStruct", of: "mvs_coarsening" },
    ],
  },
  mvs_transfer_state: {
    name: "mvs_transfer_state",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "from", nullable: false, how: "handle", of: "mvs_snapshot" },
    ],
  },
  mvs_ensemble_run: {
    name: "mvs_ensemble_run",
    returns: "mvs_result",
    steps: [
      { name: "start", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "load", nullable: false, how: "inStruct", of: "mvs_load_case" },
      { name: "settle", nullable: true, how: "inStruct", of: "mvs_settle_options" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_ensemble_options" },
      { name: "ensemble", nullable: false, how: "outHandle", of: "mvs_ensemble", freedBy: "mvs_ensemble_release" },
    ],
  },
  mvs_ensemble_release: {
    name: "mvs_ensemble_release",
    returns: "void",
    steps: [
      { name: "ensemble", nullable: true, how: "handle", of: "mvs_ensemble" },
    ],
  },
  mvs_ensemble_get_summary: {
    name: "mvs_ensemble_get_summary",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "summary", nullable: false, how: "outStruct", of: "mvs_ensemble_summary" },
    ],
  },
  mvs_ensemble_get_member: {
    name: "mvs_ensemble_get_member",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "member", nullable: false, how: "outStruct", of: "mvs_ensemble_member" },
    ],
  },
  mvs_ensemble_get_member_stats: {
    name: "mvs_ensemble_get_member_stats",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "stats", nullable: false, how: "outStruct", of: "mvs_stats" },
    ],
  },
  mvs_ensemble_get_member_profile: {
    name: "mvs_ensemble_get_member_profile",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "profile", nullable: false, how: "outStruct", of: "mvs_profile" },
    ],
  },
  mvs_ensemble_get_member_snapshot: {
    name: "mvs_ensemble_get_member_snapshot",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "snapshot", nullable: false, how: "outHandle", of: "mvs_snapshot", freedBy: "mvs_snapshot_release" },
    ],
  },
  mvs_ensemble_measure: {
    name: "mvs_ensemble_measure",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "statistic", nullable: false, how: "enum", of: "mvs_ensemble_statistic", element: "u32" },
      { name: "measures", nullable: false, how: "outStruct", of: "mvs_measures" },
    ],
  },
  mvs_ensemble_get_array: {
    name: "mvs_ensemble_get_array",
    returns: "mvs_result",
    steps: [
      { name: "ensemble", nullable: false, how: "handle", of: "mvs_ensemble" },
      { name: "which", nullable: false, how: "enum", of: "mvs_ensemble_array", element: "u32" },
      { name: "view", nullable: false, how: "outView", of: "mvs_view" },
    ],
  },
  mvs_sensitivity_run: {
    name: "mvs_sensitivity_run",
    returns: "mvs_result",
    steps: [
      { name: "snapshot", nullable: false, how: "handle", of: "mvs_snapshot" },
      { name: "quantities", nullable: false, how: "inStructs", of: "mvs_quantity" },
      { name: "parameters", nullable: false, how: "inStructs", of: "mvs_parameter" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_sensitivity_options" },
      { name: "sensitivity", nullable: false, how: "outHandle", of: "mvs_sensitivity", freedBy: "mvs_sensitivity_release" },
    ],
  },
  mvs_sensitivity_release: {
    name: "mvs_sensitivity_release",
    returns: "void",
    steps: [
      { name: "sensitivity", nullable: true, how: "handle", of: "mvs_sensitivity" },
    ],
  },
  mvs_sensitivity_get_summary: {
    name: "mvs_sensitivity_get_summary",
    returns: "mvs_result",
    steps: [
      { name: "sensitivity", nullable: false, how: "handle", of: "mvs_sensitivity" },
      { name: "summary", nullable: false, how: "outStruct", of: "mvs_sensitivity_summary" },
    ],
  },
  mvs_sensitivity_get_array: {
    name: "mvs_sensitivity_get_array",
    returns: "mvs_result",
    steps: [
      { name: "sensitivity", nullable: false, how: "handle", of: "mvs_sensitivity" },
      { name: "which", nullable: false, how: "enum", of: "mvs_sensitivity_array", element: "u32" },
      { name: "view", nullable: false, how: "outView", of: "mvs_view" },
    ],
  },
  mvs_surface_file_open: {
    name: "mvs_surface_file_open",
    returns: "mvs_result",
    steps: [
      { name: "path", nullable: false, how: "text" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_surface_file_options" },
      { name: "file", nullable: false, how: "outHandle", of: "mvs_surface_file", freedBy: "mvs_surface_file_release" },
    ],
  },
  mvs_surface_file_release: {
    name: "mvs_surface_file_release",
    returns: "void",
    steps: [
      { name: "file", nullable: true, how: "handle", of: "mvs_surface_file" },
    ],
  },
  mvs_surface_file_get_info: {
    name: "mvs_surface_file_get_info",
    returns: "mvs_result",
    steps: [
      { name: "file", nullable: false, how: "handle", of: "mvs_surface_file" },
      { name: "info", nullable: false, how: "outStruct", of: "mvs_surface_file_info" },
    ],
  },
  mvs_surface_file_get_array_count: {
    name: "mvs_surface_file_get_array_count",
    returns: "mvs_result",
    steps: [
      { name: "file", nullable: false, how: "handle", of: "mvs_surface_file" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_surface_file_get_array: {
    name: "mvs_surface_file_get_array",
    returns: "mvs_result",
    steps: [
      { name: "file", nullable: false, how: "handle", of: "mvs_surface_file" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "array", nullable: false, how: "outStruct", of: "mvs_surface_array" },
    ],
  },
  mvs_surface_file_get_name_count: {
    name: "mvs_surface_file_get_name_count",
    returns: "mvs_result",
    steps: [
      { name: "file", nullable: false, how: "handle", of: "mvs_surface_file" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_surface_file_get_name: {
    name: "mvs_surface_file_get_name",
    returns: "mvs_result",
    steps: [
      { name: "file", nullable: false, how: "handle", of: "mvs_surface_file" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "name", nullable: false, how: "outText" },
    ],
  },
  mvs_build_valve: {
    name: "mvs_build_valve",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "surface", nullable: false, how: "inStruct", of: "mvs_surface_desc" },
      { name: "options", nullable: true, how: "inStruct", of: "mvs_build_options" },
      { name: "findings", nullable: true, how: "outHandle", of: "mvs_findings", freedBy: "mvs_findings_release" },
    ],
  },
  mvs_find_leak_interval: {
    name: "mvs_find_leak_interval",
    returns: "mvs_result",
    steps: [
      { name: "sim", nullable: false, how: "handle", of: "mvs_sim" },
      { name: "errors", nullable: true, how: "inStruct", of: "mvs_leak_errors" },
      { name: "findings", nullable: false, how: "outHandle", of: "mvs_findings", freedBy: "mvs_findings_release" },
    ],
  },
  mvs_findings_get_count: {
    name: "mvs_findings_get_count",
    returns: "mvs_result",
    steps: [
      { name: "findings", nullable: false, how: "handle", of: "mvs_findings" },
      { name: "count", nullable: false, how: "outScalar", element: "u32" },
    ],
  },
  mvs_findings_get: {
    name: "mvs_findings_get",
    returns: "mvs_result",
    steps: [
      { name: "findings", nullable: false, how: "handle", of: "mvs_findings" },
      { name: "index", nullable: false, how: "scalar", of: "uint32_t", element: "u32" },
      { name: "finding", nullable: false, how: "outStruct", of: "mvs_finding" },
    ],
  },
  mvs_findings_release: {
    name: "mvs_findings_release",
    returns: "void",
    steps: [
      { name: "findings", nullable: true, how: "handle", of: "mvs_findings" },
    ],
  },
};

/** The functions under their names in C. Handles are addresses, which the caller releases. */
export class Functions extends Calls {
  /**
   * Returns the last failure on the calling thread, of any simulator; a success does not change it.
   * Valid until the thread's next failing call or its end. Never null: before any failure the code
   * is MVS_OK.
   */
  mvs_last_error(): Error_ {
    return this.invoke(signatures.mvs_last_error!, []) as never;
  }

  /**
   * Returns the name of a result code, "MVS_E_FORMAT"; "MVS_E_UNKNOWN" for an undefined number.
   * Static.
   */
  mvs_result_name(code: Result | number): string {
    return this.invoke(signatures.mvs_result_name!, [code]) as never;
  }

  /** Returns the version of the loaded library, 10000 * major + 100 * minor + patch. */
  mvs_version(): number {
    return this.invoke(signatures.mvs_version!, []) as never;
  }

  /**
   * Returns the backends (mvs_sim_desc.backend) and the optional parts of this build, separated by
   * spaces: "block cholmod eigen hdf5 zlib haptics". Static.
   */
  mvs_features(): string {
    return this.invoke(signatures.mvs_features!, []) as never;
  }

  /**
   * Fields of a struct of results in the order of the struct. Offset and type of a field are enough
   * to read it: MVS_FIELD_NUMBER is a double, MVS_FIELD_COUNT a uint32_t. The count is 0 for an
   * unknown struct.
   */
  mvs_get_field_count(which: Struct | number): number {
    return this.invoke(signatures.mvs_get_field_count!, [which]) as never;
  }

  /**
   * Fields of a struct of results in the order of the struct. Offset and type of a field are enough
   * to read it: MVS_FIELD_NUMBER is a double, MVS_FIELD_COUNT a uint32_t. The count is 0 for an
   * unknown struct.
   */
  mvs_get_field(which: Struct | number, index: number): FieldInfo {
    return this.invoke(signatures.mvs_get_field!, [which, index]) as never;
  }

  /**
   * The laws of leaflets and of chordae in the order of their numbers. MVS_E_ARGUMENT past the
   * last.
   */
  mvs_get_leaflet_law_count(): number {
    return this.invoke(signatures.mvs_get_leaflet_law_count!, []) as never;
  }

  /**
   * The laws of leaflets and of chordae in the order of their numbers. MVS_E_ARGUMENT past the
   * last.
   */
  mvs_get_leaflet_law(index: number): Law {
    return this.invoke(signatures.mvs_get_leaflet_law!, [index]) as never;
  }

  /**
   * The laws of leaflets and of chordae in the order of their numbers. MVS_E_ARGUMENT past the
   * last.
   */
  mvs_get_chord_law_count(): number {
    return this.invoke(signatures.mvs_get_chord_law_count!, []) as never;
  }

  /**
   * The laws of leaflets and of chordae in the order of their numbers. MVS_E_ARGUMENT past the
   * last.
   */
  mvs_get_chord_law(index: number): Law {
    return this.invoke(signatures.mvs_get_chord_law!, [index]) as never;
  }

  /**
   * Creates an empty simulator in *sim; mvs_destroy frees it. `desc` is nullable. MVS_E_UNSUPPORTED
   * if this build lacks the backend; MVS_E_ARGUMENT for too many workers or half of a pool.
   */
  mvs_create(desc?: SimDesc | null): SimHandle {
    return this.invoke(signatures.mvs_create!, [desc]) as never;
  }

  /** Frees a simulator outside of any call on it; its snapshots stay valid. `sim` is nullable. */
  mvs_destroy(sim: SimHandle | null): void {
    return this.invoke(signatures.mvs_destroy!, [sim]) as never;
  }

  /**
   * Replaces the valve by one described by arrays, at rest and without load. The arrays are copied.
   * MVS_E_OP names the first fault of an invalid valve; mvs_check_valve reports all faults. A
   * variant of the present valve shares with it what depends on the mesh alone: topology, the
   * checks of the mesh, the coarser meshes of mvs_settle. A variant has the same nodes, triangles,
   * leaflets, fibres, annulus and heads, and chordae of the same kinds between the same nodes; rest
   * lengths, laws, constants, thickness, names and the load may differ (other thickness: no shared
   * coarser meshes). To close many variants fast, restore each simulator (mvs_restore) to a
   * snapshot of one of them first; it may be one simulator, or several in threads. mvs_load_file,
   * mvs_set_leaflet and operations share in the same way. It changes no bit. Suspicious input is
   * logged as MVS_LOG_WARNING, also by mvs_load_file and mvs_set_leaflet: needle-shaped triangles,
   * tissue that crosses or touches itself at rest, and numbers that look like those of another
   * unit.
   */
  mvs_set_valve(sim: SimHandle, valve: ValveDesc): void {
    return this.invoke(signatures.mvs_set_valve!, [sim, valve]) as never;
  }

  /**
   * Replaces the valve by a parametric mitral valve. `desc` is nullable: the default valve.
   * MVS_E_ARGUMENT names an impossible dimension. Its rest shape is no equilibrium without load:
   * chordae are taut there (libmvs/anatomy/PARAMETRIC.md), and a settle at zero pressure moves it.
   */
  mvs_generate_valve(sim: SimHandle, desc?: ParametricDesc | null): void {
    return this.invoke(signatures.mvs_generate_valve!, [sim, desc]) as never;
  }

  /**
   * Checks a valve without a simulator: returns the result that mvs_set_valve would return, and
   * reports every fault. Faults that prevent further checks (an index out of range) are reported
   * alone. With MVS_OK the sentences are warnings: triangles that cross, needles, edges shorter
   * than the contact thickness. `fault` and `user` are nullable.
   */
  mvs_check_valve(valve: ValveDesc, fault: FaultCallback): number {
    return this.invoke(signatures.mvs_check_valve!, [valve, fault]) as never;
  }

  /**
   * Changes the tissue of a leaflet, of all leaflets if `leaflet` is 0: law, thickness and
   * constants of `tissue`, whose name is null and whose id is 0. A thickness of 0 keeps the present
   * one; another thickness scales that of each triangle. Constants of 0 take the law's defaults,
   * -0.0 is zero; MVS_LEAFLET_LAW_BILINEAR without constants, on a leaflet of springs, becomes the
   * membrane that follows the curve of those springs. Shape, chordae and load do not change; the
   * history is emptied, because operations cannot be undone into another tissue, and an open
   * journal ends. MVS_E_ID if the leaflet does not exist, MVS_E_OP for constants that the law
   * cannot have.
   */
  mvs_set_leaflet(sim: SimHandle, leaflet: bigint | number, tissue: LeafletDesc): void {
    return this.invoke(signatures.mvs_set_leaflet!, [sim, leaflet, tissue]) as never;
  }

  /**
   * Sets the load for the next settle or step; nothing moves yet. A new valve has pressure 0 and
   * fraction 0. A pressure that looks like a value in mmHg is logged as MVS_LOG_WARNING. The
   * history records loads for plans. Each change of the load with a step after it takes 290 bytes
   * of memory (260 MB an hour at 250 steps a second) and 150 bytes in a plan; changes without a
   * step or settle between them are one. The same load again, without an operation in between,
   * records and changes nothing. A settle takes 130 bytes, also at rest.
   */
  mvs_set_load(sim: SimHandle, load: LoadCaseInput): void {
    return this.invoke(signatures.mvs_set_load!, [sim, load]) as never;
  }

  /** Reads the load. */
  mvs_get_load(sim: SimHandle): LoadCase {
    return this.invoke(signatures.mvs_get_load!, [sim]) as never;
  }

  /**
   * Moves the valve to stable static equilibrium under the load: an unstable one (mvs_stability) is
   * left along its mode; a valve that always returns to it (its free edge flutters) stays there.
   * Ending without convergence is not an error: stats->converged is 0, the valve is at the last
   * iterate, or at that equilibrium with growth_rate > 0. MVS_E_CANCELLED if the progress callback
   * cancelled, MVS_E_DIVERGED if numbers left their range, or if a leaflet grows to ten times its
   * area because its law cannot bear the pressure. `options` and `stats` are nullable. A chord that
   * an operation of the history attached and that carries no force at rest under pressure is logged
   * as MVS_LOG_WARNING: its rest length is too long to hold the leaflet.
   */
  mvs_settle(sim: SimHandle, options?: SettleOptions | null): Stats {
    return this.invoke(signatures.mvs_settle!, [sim, options]) as never;
  }

  /**
   * Begins a settle in slices, for a host whose only thread has to answer in between (the worker of
   * a browser, a window). The result has the same bits as that of mvs_settle. Until the end the
   * valve is as before: it may be read. A call that replaces the present snapshot cancels the
   * settle: one that changes valve, state, tools or history, also mvs_set_load with the same load,
   * mvs_begin_group, mvs_set_checkpoint, mvs_replay_plan and mvs_recover_journal. Replaces a settle
   * already begun. `options` is nullable.
   */
  mvs_begin_settle(sim: SimHandle, options?: SettleOptions | null): void {
    return this.invoke(signatures.mvs_begin_settle!, [sim, options]) as never;
  }

  /**
   * Advances the settle for `seconds`, 0 to 3600, and at least one iteration of Newton's method or
   * one step in time. *share is the completed share in [0, 1]; 1: the settle has ended, the valve
   * is that of mvs_settle, and `stats` is written. MVS_E_STATE if no settle is under way. The codes
   * of mvs_settle, and the progress callback if it cancels, end the settle; the valve is as before.
   * `share` and `stats` are nullable.
   */
  mvs_advance_settle(sim: SimHandle, seconds: number): { share: number; stats: Stats } {
    return this.invoke(signatures.mvs_advance_settle!, [sim, seconds]) as never;
  }

  /** Cancels a settle in slices, if one is under way. */
  mvs_cancel_settle(sim: SimHandle): void {
    return this.invoke(signatures.mvs_cancel_settle!, [sim]) as never;
  }

  /**
   * Advances by one time step: a bounded amount of work without progress callbacks. Once its
   * buffers hold the contact that the motion makes (up to 100 steps after a change) it makes no
   * allocation and no system call while no snapshot of the valve is held and no hand has moved. An
   * operation, mvs_end_group, undo, redo, mvs_restore_checkpoint, or adding or removing a tool
   * prepares the next step of a valve that is being stepped within its own call. MVS_E_DIVERGED if
   * numbers left their range: use a smaller dt; MVS_E_UNSUPPORTED for the explicit solver with a
   * tool that pushes, as of mvs_settle. `options` is nullable.
   */
  mvs_step(sim: SimHandle, options?: StepOptions | null): void {
    return this.invoke(signatures.mvs_step!, [sim, options]) as never;
  }

  /**
   * Does now what the first mvs_step from here would do for the steps after it: memory, the search
   * for contact, an elimination order and a factor, several times the work of a step. For a valve
   * that is about to be stepped in real time, after mvs_settle, another load, a snapshot or a file.
   * Changes nothing but the time of the steps, whose options these are. The errors of mvs_step.
   * `options` is nullable.
   */
  mvs_prepare_step(sim: SimHandle, options?: StepOptions | null): void {
    return this.invoke(signatures.mvs_prepare_step!, [sim, options]) as never;
  }

  /**
   * Reads the statistics of the last settle or step of this valve; MVS_E_STATE before the first.
   * `converged` is 1 while the valve is at rest: an operation, another load or a tool makes it 0
   * until the next settle, or a step that finds nothing to move; so does a step that moves it.
   */
  mvs_get_stats(sim: SimHandle): Stats {
    return this.invoke(signatures.mvs_get_stats!, [sim]) as never;
  }

  /**
   * Returns the valve and state after the last finished call; release it with mvs_snapshot_release.
   * From any thread, also during a call on the simulator. No array is copied.
   */
  mvs_get_snapshot(sim: SimHandle): SnapshotHandle {
    return this.invoke(signatures.mvs_get_snapshot!, [sim]) as never;
  }

  /** Add and drop a reference. `snapshot` is nullable. */
  mvs_snapshot_retain(snapshot: SnapshotHandle | null): void {
    return this.invoke(signatures.mvs_snapshot_retain!, [snapshot]) as never;
  }

  /** Add and drop a reference. `snapshot` is nullable. */
  mvs_snapshot_release(snapshot: SnapshotHandle | null): void {
    return this.invoke(signatures.mvs_snapshot_release!, [snapshot]) as never;
  }

  /** Restores a simulator to a snapshot of this or another simulator, bit for bit. */
  mvs_restore(sim: SimHandle, snapshot: SnapshotHandle): void {
    return this.invoke(signatures.mvs_restore!, [sim, snapshot]) as never;
  }

  /**
   * Returns a 128-bit hash of model and state: equal for equal inputs of the next step, but for a
   * move of a tool that no step or settle has used yet (mvs_move_tool): neither snapshots nor files
   * have it. The hash of a snapshot may differ between versions of the library.
   */
  mvs_snapshot_get_hash(snapshot: SnapshotHandle): bigint[] {
    return this.invoke(signatures.mvs_snapshot_get_hash!, [snapshot]) as never;
  }

  /**
   * Returns a view of one array, zero-copy, valid while the snapshot is held. Forces, strains,
   * coaptation and orifice are computed at the first call that needs them.
   */
  mvs_snapshot_get_array(snapshot: SnapshotHandle, which: ArrayKind | number): ArrayView {
    return this.invoke(signatures.mvs_snapshot_get_array!, [snapshot, which]) as never;
  }

  /** Returns the number of parts of a kind. */
  mvs_snapshot_get_part_count(snapshot: SnapshotHandle, kind: PartKind | number): number {
    return this.invoke(signatures.mvs_snapshot_get_part_count!, [snapshot, kind]) as never;
  }

  /** Returns part `index` of a kind. */
  mvs_snapshot_get_part(snapshot: SnapshotHandle, kind: PartKind | number, index: number): Part {
    return this.invoke(signatures.mvs_snapshot_get_part!, [snapshot, kind, index]) as never;
  }

  /** Finds the part of a kind with this name; MVS_E_ID if the valve has no such part. */
  mvs_snapshot_find_part(snapshot: SnapshotHandle, kind: PartKind | number, name: string): Part {
    return this.invoke(signatures.mvs_snapshot_find_part!, [snapshot, kind, name]) as never;
  }

  /** Returns chord segment `index` of a snapshot. */
  mvs_snapshot_get_chord(snapshot: SnapshotHandle, index: number): ChordInfo {
    return this.invoke(signatures.mvs_snapshot_get_chord!, [snapshot, index]) as never;
  }

  /**
   * Returns the name of the valve, valid while the snapshot is held. Never null; "" for a null
   * snapshot.
   */
  mvs_snapshot_get_name(snapshot: SnapshotHandle): string {
    return this.invoke(signatures.mvs_snapshot_get_name!, [snapshot]) as never;
  }

  /** Reads the load of the snapshot. */
  mvs_snapshot_get_load(snapshot: SnapshotHandle): LoadCase {
    return this.invoke(signatures.mvs_snapshot_get_load!, [snapshot]) as never;
  }

  /**
   * Reads whether the snapshot is at rest. A settle that converges and a step that moves nothing
   * find rest; a change of valve, load or tools, and a step that moves, end it. Undo and files
   * restore it. A valve from another program is not known to be at rest.
   */
  mvs_snapshot_get_rest(snapshot: SnapshotHandle): Rest {
    return this.invoke(signatures.mvs_snapshot_get_rest!, [snapshot]) as never;
  }

  /**
   * Computes the stability at the positions of a snapshot, with a relative error of the margins
   * below 1 %. Away from rest it is that of the tangent there. The mode is MVS_ARRAY_NODE_MODE. The
   * first call for a snapshot takes the time of a few Newton iterations.
   */
  mvs_snapshot_get_stability(snapshot: SnapshotHandle): Stability {
    return this.invoke(signatures.mvs_snapshot_get_stability!, [snapshot]) as never;
  }

  /**
   * Returns the number of regions: the scallops in their order, then the commissures, one where the
   * attachments of two leaflets meet: two of a mitral valve.
   */
  mvs_snapshot_get_region_count(snapshot: SnapshotHandle): number {
    return this.invoke(signatures.mvs_snapshot_get_region_count!, [snapshot]) as never;
  }

  /** Returns region `index` of a snapshot. The first call computes all regions. */
  mvs_snapshot_get_region(snapshot: SnapshotHandle, index: number): RegionMeasures {
    return this.invoke(signatures.mvs_snapshot_get_region!, [snapshot, index]) as never;
  }

  /** Returns the number of parts of the orifice; 0 for a sealed valve. */
  mvs_snapshot_get_orifice_part_count(snapshot: SnapshotHandle): number {
    return this.invoke(signatures.mvs_snapshot_get_orifice_part_count!, [snapshot]) as never;
  }

  /** Returns part `index` of the orifice, the largest first. */
  mvs_snapshot_get_orifice_part(snapshot: SnapshotHandle, index: number): OrificePart {
    return this.invoke(signatures.mvs_snapshot_get_orifice_part!, [snapshot, index]) as never;
  }

  /**
   * Returns the working range of chordae of a kind: largest strain and tension in N; infinite for
   * sutures. It is no limit of strength: a chord outside it deserves inspection. Sources:
   * libmvs/measure/DEFINITIONS.md.
   */
  mvs_get_chord_limits(kind: ChordKind | number): { strain: number; tension: number } {
    return this.invoke(signatures.mvs_get_chord_limits!, [kind]) as never;
  }

  /** Measures a snapshot. The first call computes the measures, later calls return the same ones. */
  mvs_snapshot_measure(snapshot: SnapshotHandle): Measures {
    return this.invoke(signatures.mvs_snapshot_measure!, [snapshot]) as never;
  }

  /**
   * Measures some groups, MVS_MEASURE_GROUP_* joined by |, with the same bits as
   * mvs_snapshot_measure. Numbers of the other groups are NaN, their counts are 0, and computing
   * them takes no time. Later calls return what an earlier call has computed.
   */
  mvs_snapshot_measure_groups(snapshot: SnapshotHandle, groups: number): Measures {
    return this.invoke(signatures.mvs_snapshot_measure_groups!, [snapshot, groups]) as never;
  }

  /** Compares the leaflet surfaces of two snapshots. */
  mvs_snapshot_compare(a: SnapshotHandle, b: SnapshotHandle): Comparison {
    return this.invoke(signatures.mvs_snapshot_compare!, [a, b]) as never;
  }

  /**
   * Intersects the leaflets with a plane: segments as pairs of points, 3 doubles each, in m. Writes
   * at most `capacity` points and stores their number, 2 x segments, in *count. The normal may have
   * any length but 0.
   */
  mvs_snapshot_section(snapshot: SnapshotHandle, point: ArrayLike<number>, normal: ArrayLike<number>): Float64Array {
    return this.invoke(signatures.mvs_snapshot_section!, [snapshot, point, normal]) as never;
  }

  /**
   * Returns the anatomical frame of the valve: rows are the origin in m (annulus centroid), the AP
   * axis (towards the anterior leaflet), the CC axis and the axis into the atrium; right-handed,
   * unit vectors.
   */
  mvs_snapshot_get_frame(snapshot: SnapshotHandle): number[] {
    return this.invoke(signatures.mvs_snapshot_get_frame!, [snapshot]) as never;
  }

  /**
   * Measures the cost of the repair of a snapshot. The snapshot is of the closed valve; it is then
   * opened in a copy: boundary_fraction 0, a pressure difference that opens, Newton's method.
   * *opened receives the open valve, the same bits as after mvs_restore, mvs_set_load and
   * mvs_settle; release it with mvs_snapshot_release. Tools stay as they are. If the open valve
   * does not come to rest, cost->opened is 0. MVS_E_CANCELLED if the callback cancelled. `options`
   * and `opened` are nullable. From any thread.
   */
  mvs_snapshot_measure_cost(snapshot: SnapshotHandle, options?: CostOptions | null): { cost: Cost; opened: SnapshotHandle } {
    return this.invoke(signatures.mvs_snapshot_measure_cost!, [snapshot, options]) as never;
  }

  /**
   * Checks whether an operation can be applied now; nothing changes. MVS_E_OP for an impossible
   * operation, MVS_E_ID for a missing part or a part of another kind, MVS_E_ARGUMENT for a value
   * out of its range or left out; the sentence names the operation, the part and the remedy. It
   * reads the present snapshot, so that it may be called from any thread at any time.
   */
  mvs_check_op(sim: SimHandle, op: Operation): void {
    return this.invoke(signatures.mvs_check_op!, [sim, op]) as never;
  }

  /**
   * Applies an operation and stores the id of the part that it made in *made (0: it made no part).
   * Operations undone before can no longer be redone. `made` is nullable.
   */
  mvs_apply_op(sim: SimHandle, op: Operation): bigint {
    return this.invoke(signatures.mvs_apply_op!, [sim, op]) as never;
  }

  /**
   * Reverts the last operation, or the whole last group, bit for bit: the state is that directly
   * before it. MVS_E_STATE without an operation to undo.
   */
  mvs_undo(sim: SimHandle): void {
    return this.invoke(signatures.mvs_undo!, [sim]) as never;
  }

  /**
   * Repeats the operation or group undone last, bit for bit: the state is that directly after it,
   * of a group directly after its last operation, so that the settles and steps which followed are
   * to be made again. MVS_E_STATE without an operation to redo.
   */
  mvs_redo(sim: SimHandle): void {
    return this.invoke(signatures.mvs_redo!, [sim]) as never;
  }

  /**
   * Begin and end a group: its operations are undone and redone together, shown as `name` in a
   * menu. Groups do not nest; an empty group is discarded. While one is open, undo, redo and
   * restoring give MVS_E_STATE. A new valve or a file ends it. A checkpoint that is set in a group
   * keeps the operations before it as a group of their own.
   */
  mvs_begin_group(sim: SimHandle, name: string): void {
    return this.invoke(signatures.mvs_begin_group!, [sim, name]) as never;
  }

  /**
   * Begin and end a group: its operations are undone and redone together, shown as `name` in a
   * menu. Groups do not nest; an empty group is discarded. While one is open, undo, redo and
   * restoring give MVS_E_STATE. A new valve or a file ends it. A checkpoint that is set in a group
   * keeps the operations before it as a group of their own.
   */
  mvs_end_group(sim: SimHandle): void {
    return this.invoke(signatures.mvs_end_group!, [sim]) as never;
  }

  /** Stores valve, state and history under a name; replaces a checkpoint of the same name. */
  mvs_set_checkpoint(sim: SimHandle, name: string): void {
    return this.invoke(signatures.mvs_set_checkpoint!, [sim, name]) as never;
  }

  /** Restores a checkpoint, bit for bit; all checkpoints remain. MVS_E_ID for an unknown name. */
  mvs_restore_checkpoint(sim: SimHandle, name: string): void {
    return this.invoke(signatures.mvs_restore_checkpoint!, [sim, name]) as never;
  }

  /** Reads the size of the history of a snapshot. */
  mvs_snapshot_get_history(snapshot: SnapshotHandle): History {
    return this.invoke(signatures.mvs_snapshot_get_history!, [snapshot]) as never;
  }

  /**
   * Reads entry `index` of a history: 0 to done - 1 are the operations from the first to the last,
   * then follow `undone` entries in the order in which they would be redone.
   */
  mvs_snapshot_get_history_entry(snapshot: SnapshotHandle, index: number): HistoryEntry {
    return this.invoke(signatures.mvs_snapshot_get_history_entry!, [snapshot, index]) as never;
  }

  /** Returns the name of checkpoint `index`, 0 to checkpoints - 1; valid while the snapshot is held. */
  mvs_snapshot_get_checkpoint(snapshot: SnapshotHandle, index: number): string {
    return this.invoke(signatures.mvs_snapshot_get_checkpoint!, [snapshot, index]) as never;
  }

  /** Returns the number of kinds of operations. */
  mvs_get_op_count(): number {
    return this.invoke(signatures.mvs_get_op_count!, []) as never;
  }

  /** Describes kind `index`, in the order of their numbers. */
  mvs_get_op_info(index: number): OpInfo {
    return this.invoke(signatures.mvs_get_op_info!, [index]) as never;
  }

  /** Describes field `field` of kind `index`. */
  mvs_get_op_field(index: number, field: number): FieldInfo {
    return this.invoke(signatures.mvs_get_op_field!, [index, field]) as never;
  }

  /**
   * Write the plan of a snapshot, from the valve that was set or loaded to the snapshot: to a file,
   * or to memory (at most `capacity` bytes; stores the number of bytes of the whole plan in *size;
   * `data` is nullable if `capacity` is 0). `options` is nullable.
   */
  mvs_write_plan(snapshot: SnapshotHandle, options?: PlanOptions | null): Uint8Array {
    return this.invoke(signatures.mvs_write_plan!, [snapshot, options]) as never;
  }

  /**
   * Replays a plan, the text of its file, on the present valve: completely, or not at all with a
   * sentence about the step that failed. Settling and stepping are replayed as well; the progress
   * callback is called for each of them and can cancel (MVS_E_CANCELLED). `replay` is nullable.
   */
  mvs_replay_plan(sim: SimHandle, data: Uint8Array | string): Replay {
    return this.invoke(signatures.mvs_replay_plan!, [sim, data]) as never;
  }

  /**
   * Checks whether mvs_replay_plan would apply every operation of a plan, and that its tools exist
   * where it moves or removes them. The simulator does not change; settling is not replayed. Warns
   * as mvs_replay_plan of other units, from the calling thread. `sim` is nullable: what depends on
   * no valve is checked, such as keys and types. `replay` is nullable.
   */
  mvs_check_plan(sim: SimHandle | null, data: Uint8Array | string): Replay {
    return this.invoke(signatures.mvs_check_plan!, [sim, data]) as never;
  }

  /**
   * Adds a tool to the state; *tool is its id, unique for this valve. The spring of a grasp has no
   * rest length: a node 5 mm from the hand is pulled with 1 N (200 N/m) from the first step on. Add
   * it with `position` at the node, and move the hand from there, to begin without force.
   * MVS_E_ARGUMENT if a value is out of its range, no node is within reach, or a tool that pushes
   * is farther from the middle of the valve than ten times its size; MVS_E_STATE if a tool that
   * pushes would overlap tissue, or there are MVS_MAX_TOOLS.
   */
  mvs_add_tool(sim: SimHandle, desc: ToolDesc): bigint {
    return this.invoke(signatures.mvs_add_tool!, [sim, desc]) as never;
  }

  /**
   * Moves the hand of a tool. The next mvs_settle or mvs_step starts with the last position of each
   * hand; until then snapshots show the previous one. From any thread, also during a call on the
   * simulator. `axis` is nullable: unchanged; tools other than rods ignore it. MVS_E_ID if the tool
   * does not exist; MVS_E_ARGUMENT if a coordinate is not within 10 m, or an axis has no length.
   * mvs_restore and a new valve discard a move that no settle or step has used; mvs_undo keeps it.
   * The history records the motion of hands for plans: 30 bytes of memory for each step of a hand
   * that moved (27 MB an hour at 250 steps a second), 33 bytes in a plan; a resting hand adds
   * nothing. A tool that is added and removed takes 840 bytes of memory.
   */
  mvs_move_tool(sim: SimHandle, tool: bigint | number, position: ArrayLike<number>, axis?: ArrayLike<number> | null): void {
    return this.invoke(signatures.mvs_move_tool!, [sim, tool, position, axis]) as never;
  }

  /**
   * The same with an orientation, w x y z of a quaternion of any length but 0, of a convex tool; a
   * rod takes the z axis that it turns to, others have none. `orientation` is nullable: unchanged.
   */
  mvs_move_tool_pose(sim: SimHandle, tool: bigint | number, position: ArrayLike<number>, orientation?: ArrayLike<number> | null): void {
    return this.invoke(signatures.mvs_move_tool_pose!, [sim, tool, position, orientation]) as never;
  }

  /** Removes a tool from the state; a grasp releases its node. MVS_E_ID if it does not exist. */
  mvs_remove_tool(sim: SimHandle, tool: bigint | number): void {
    return this.invoke(signatures.mvs_remove_tool!, [sim, tool]) as never;
  }

  /** Reads a tool of the present snapshot by its id, from any thread; MVS_E_ID if it does not exist. */
  mvs_get_tool(sim: SimHandle, tool: bigint | number): ToolState {
    return this.invoke(signatures.mvs_get_tool!, [sim, tool]) as never;
  }

  /** The tools of a snapshot in the order of their addition. */
  mvs_snapshot_get_tool_count(snapshot: SnapshotHandle): number {
    return this.invoke(signatures.mvs_snapshot_get_tool_count!, [snapshot]) as never;
  }

  /** The tools of a snapshot in the order of their addition. */
  mvs_snapshot_get_tool(snapshot: SnapshotHandle, index: number): ToolState {
    return this.invoke(signatures.mvs_snapshot_get_tool!, [snapshot, index]) as never;
  }

  /** Body `body` of tool `index` of a snapshot; its views are valid while the snapshot is held. */
  mvs_snapshot_get_tool_body(snapshot: SnapshotHandle, index: number, body: number): ToolBody {
    return this.invoke(signatures.mvs_snapshot_get_tool_body!, [snapshot, index, body]) as never;
  }

  /** Loads from `size` bytes of memory; AUTO is MVS_FORMAT_OBJ. */
  mvs_load_memory(sim: SimHandle, data: Uint8Array | string, format: Format | number): void {
    return this.invoke(signatures.mvs_load_memory!, [sim, data, format]) as never;
  }

  /**
   * Writes a snapshot to memory: at most `capacity` bytes; stores the number of bytes of the whole
   * file in *size. AUTO is MVS_FORMAT_OBJ. `data` is nullable if `capacity` is 0.
   */
  mvs_save_memory(snapshot: SnapshotHandle, format: Format | number): Uint8Array {
    return this.invoke(signatures.mvs_save_memory!, [snapshot, format]) as never;
  }

  /** Reads the profile of the last settle or step of this valve; MVS_E_STATE before the first. */
  mvs_get_profile(sim: SimHandle): Profile {
    return this.invoke(signatures.mvs_get_profile!, [sim]) as never;
  }

  /**
   * Replaces the valve by the next finer level: each triangle is divided into four. Old nodes keep
   * their index, new nodes follow. Parts, names, ids, materials and chordae do not change; the
   * state is interpolated; the history starts anew, as with mvs_load_file. MVS_E_ARGUMENT beyond
   * 2^24 triangles.
   */
  mvs_refine_valve(sim: SimHandle): void {
    return this.invoke(signatures.mvs_refine_valve!, [sim]) as never;
  }

  /**
   * Replaces the valve by a coarser level: vertices are removed, the remaining ones do not move.
   * Annulus, free edge, borders of leaflets and scallops lose vertices only along themselves;
   * chordae of a removed vertex move to a vertex that has chordae. The state is that of the
   * remaining vertices; the history starts anew. MVS_E_ARGUMENT states the smallest possible number
   * of vertices if the target is below it, and if the valve has fewer vertices than asked for.
   * `made` is nullable.
   */
  mvs_coarsen_valve(sim: SimHandle, options: CoarsenOptions): Coarsening {
    return this.invoke(signatures.mvs_coarsen_valve!, [sim, options]) as never;
  }

  /**
   * Transfers positions, velocities, time and load from a snapshot of a coarser or finer level of
   * the same valve. A coarser level takes the state of the common nodes. A finer level interpolates
   * on the triangles of the coarse one, which reproduces the rest shape and rigid motions to
   * rounding; prescribed nodes take their prescribed positions. The history starts anew.
   * MVS_E_ARGUMENT if the two are not levels of one valve.
   */
  mvs_transfer_state(sim: SimHandle, from: SnapshotHandle): void {
    return this.invoke(signatures.mvs_transfer_state!, [sim, from]) as never;
  }

  /**
   * Closes the valve of a snapshot once per member and stores the results in *ensemble;
   * mvs_ensemble_release frees it. A member that does not converge or diverges is marked and
   * excluded from all statistics; divergence of member 0 is the failure MVS_E_DIVERGED.
   * MVS_E_CANCELLED if the progress callback cancelled. settle->max_iterations limits the last
   * settle of a member, not those on its way. `settle` and `options` are nullable.
   */
  mvs_ensemble_run(start: SnapshotHandle, load: LoadCaseInput, settle?: SettleOptions | null, options?: EnsembleOptions | null): EnsembleHandle {
    return this.invoke(signatures.mvs_ensemble_run!, [start, load, settle, options]) as never;
  }

  /** Frees an ensemble; snapshots taken from it stay valid. `ensemble` is nullable. */
  mvs_ensemble_release(ensemble: EnsembleHandle | null): void {
    return this.invoke(signatures.mvs_ensemble_release!, [ensemble]) as never;
  }

  /** Reads the summary. */
  mvs_ensemble_get_summary(ensemble: EnsembleHandle): EnsembleSummary {
    return this.invoke(signatures.mvs_ensemble_get_summary!, [ensemble]) as never;
  }

  /**
   * Read one member, 0 to members - 1: its outcome, and its statistics and profile summed over all
   * increments with the residual at its end.
   */
  mvs_ensemble_get_member(ensemble: EnsembleHandle, index: number): EnsembleMember {
    return this.invoke(signatures.mvs_ensemble_get_member!, [ensemble, index]) as never;
  }

  /**
   * Read one member, 0 to members - 1: its outcome, and its statistics and profile summed over all
   * increments with the residual at its end.
   */
  mvs_ensemble_get_member_stats(ensemble: EnsembleHandle, index: number): Stats {
    return this.invoke(signatures.mvs_ensemble_get_member_stats!, [ensemble, index]) as never;
  }

  /**
   * Read one member, 0 to members - 1: its outcome, and its statistics and profile summed over all
   * increments with the residual at its end.
   */
  mvs_ensemble_get_member_profile(ensemble: EnsembleHandle, index: number): Profile {
    return this.invoke(signatures.mvs_ensemble_get_member_profile!, [ensemble, index]) as never;
  }

  /**
   * Returns the closed valve of a member; release it with mvs_snapshot_release. Member 0 continues
   * the history of the start; the others begin a new history.
   */
  mvs_ensemble_get_member_snapshot(ensemble: EnsembleHandle, index: number): SnapshotHandle {
    return this.invoke(signatures.mvs_ensemble_get_member_snapshot!, [ensemble, index]) as never;
  }

  /**
   * Returns a statistic of every figure of mvs_measures, in the units of that struct. NaN: no
   * member has the figure, or fewer than two have it for a deviation. Figures that are counts are
   * rounded to whole numbers, with 0 instead of NaN.
   */
  mvs_ensemble_measure(ensemble: EnsembleHandle, statistic: EnsembleStatistic | number): Measures {
    return this.invoke(signatures.mvs_ensemble_measure!, [ensemble, statistic]) as never;
  }

  /** Returns a view of one array, zero-copy, valid until the ensemble is released. */
  mvs_ensemble_get_array(ensemble: EnsembleHandle, which: EnsembleArray | number): ArrayView {
    return this.invoke(signatures.mvs_ensemble_get_array!, [ensemble, which]) as never;
  }

  /**
   * Differentiates quantities of a snapshot at rest with respect to parameters; lists with strides
   * as in mvs_valve_desc. The snapshot does not change. `options` is nullable. `sensitivity`:
   * release it with mvs_sensitivity_release. From any thread. MVS_E_STATE if the snapshot is not at
   * rest, or its equilibrium is unstable; MVS_E_ARGUMENT for a quantity or parameter that the valve
   * does not have, or that has no derivative; MVS_E_CANCELLED if the progress callback cancelled.
   */
  mvs_sensitivity_run(snapshot: SnapshotHandle, quantities: readonly Quantity[], parameters: readonly Parameter[], options?: SensitivityOptions | null): SensitivityHandle {
    return this.invoke(signatures.mvs_sensitivity_run!, [snapshot, quantities, parameters, options]) as never;
  }

  /** Releases a result. `sensitivity` is nullable. */
  mvs_sensitivity_release(sensitivity: SensitivityHandle | null): void {
    return this.invoke(signatures.mvs_sensitivity_release!, [sensitivity]) as never;
  }

  /** Reads the summary. */
  mvs_sensitivity_get_summary(sensitivity: SensitivityHandle): SensitivitySummary {
    return this.invoke(signatures.mvs_sensitivity_get_summary!, [sensitivity]) as never;
  }

  /** Returns a view of one array, zero-copy, valid until the result is released. */
  mvs_sensitivity_get_array(sensitivity: SensitivityHandle, which: SensitivityArray | number): ArrayView {
    return this.invoke(signatures.mvs_sensitivity_get_array!, [sensitivity, which]) as never;
  }

  /**
   * Reads a file; release it with mvs_surface_file_release. The ending of the path selects the
   * format. MVS_E_FORMAT with the line, the point or the polygon that is wrong; MVS_E_UNSUPPORTED,
   * with the remedy, for a variant that is not read. `options` is nullable.
   */
  mvs_surface_file_open(path: string, options?: SurfaceFileOptions | null): SurfaceFileHandle {
    return this.invoke(signatures.mvs_surface_file_open!, [path, options]) as never;
  }

  /** Releases a file. `file` is nullable. */
  mvs_surface_file_release(file: SurfaceFileHandle | null): void {
    return this.invoke(signatures.mvs_surface_file_release!, [file]) as never;
  }

  /** Returns the points and triangles of a file. */
  mvs_surface_file_get_info(file: SurfaceFileHandle): SurfaceFileInfo {
    return this.invoke(signatures.mvs_surface_file_get_info!, [file]) as never;
  }

  /** The arrays of a file, in its order. */
  mvs_surface_file_get_array_count(file: SurfaceFileHandle): number {
    return this.invoke(signatures.mvs_surface_file_get_array_count!, [file]) as never;
  }

  /** The arrays of a file, in its order. */
  mvs_surface_file_get_array(file: SurfaceFileHandle, index: number): SurfaceArray {
    return this.invoke(signatures.mvs_surface_file_get_array!, [file, index]) as never;
  }

  /** The names of points ("AL", "PM"): none, or one for each point. */
  mvs_surface_file_get_name_count(file: SurfaceFileHandle): number {
    return this.invoke(signatures.mvs_surface_file_get_name_count!, [file]) as never;
  }

  /** The names of points ("AL", "PM"): none, or one for each point. */
  mvs_surface_file_get_name(file: SurfaceFileHandle, index: number): string {
    return this.invoke(signatures.mvs_surface_file_get_name!, [file, index]) as never;
  }

  /**
   * Replaces the valve of a simulator by one that is built from a surface, open and without load,
   * and begins a history, like mvs_generate_valve. `options` is nullable. `findings` is nullable,
   * else release it with mvs_findings_release. Faults of the surface that no rule mends give
   * MVS_E_OP and a sentence; the simulator is unchanged then. Closures of variants, of a fit and
   * for the leak, run at the same time on the workers of the simulator (mvs_sim_desc), with the
   * same bits. MVS_E_CANCELLED if the progress callback of the simulator cancelled.
   */
  mvs_build_valve(sim: SimHandle, surface: SurfaceDesc, options?: BuildOptions | null): FindingsHandle {
    return this.invoke(signatures.mvs_build_valve!, [sim, surface, options]) as never;
  }

  /**
   * Closes the valve of a simulator from its open shape under 120 mmHg with chordae of other
   * lengths and leaflets of other thicknesses, up to `errors`: up to 11 closures; 3, or 5 with an
   * error of the thickness, if all of these are sealed. `errors` is nullable. `findings` gets
   * "leak", "leak_interval", without values if too few came to rest, and "leak_limits", m2, as
   * those of a build; release it with mvs_findings_release. The simulator is unchanged.
   * MVS_E_CANCELLED if the progress callback of the simulator cancelled.
   */
  mvs_find_leak_interval(sim: SimHandle, errors?: LeakErrors | null): FindingsHandle {
    return this.invoke(signatures.mvs_find_leak_interval!, [sim, errors]) as never;
  }

  /**
   * Closes the valve of a simulator from its open shape under 120 mmHg with chordae of other
   * lengths and leaflets of other thicknesses, up to `errors`: up to 11 closures; 3, or 5 with an
   * error of the thickness, if all of these are sealed. `errors` is nullable. `findings` gets
   * "leak", "leak_interval", without values if too few came to rest, and "leak_limits", m2, as
   * those of a build; release it with mvs_findings_release. The simulator is unchanged.
   * MVS_E_CANCELLED if the progress callback of the simulator cancelled.
   */
  mvs_findings_get_count(findings: FindingsHandle): number {
    return this.invoke(signatures.mvs_findings_get_count!, [findings]) as never;
  }

  /**
   * Closes the valve of a simulator from its open shape under 120 mmHg with chordae of other
   * lengths and leaflets of other thicknesses, up to `errors`: up to 11 closures; 3, or 5 with an
   * error of the thickness, if all of these are sealed. `errors` is nullable. `findings` gets
   * "leak", "leak_interval", without values if too few came to rest, and "leak_limits", m2, as
   * those of a build; release it with mvs_findings_release. The simulator is unchanged.
   * MVS_E_CANCELLED if the progress callback of the simulator cancelled.
   */
  mvs_findings_get(findings: FindingsHandle, index: number): Finding {
    return this.invoke(signatures.mvs_findings_get!, [findings, index]) as never;
  }

  /** Releases findings. `findings` is nullable. */
  mvs_findings_release(findings: FindingsHandle | null): void {
    return this.invoke(signatures.mvs_findings_release!, [findings]) as never;
  }
}
