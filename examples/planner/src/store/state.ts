// The state of the page as signals: valve, preview, choice, form, running request.
import { batch, computed, effect, signal } from '@preact/signals';
import type {
  CheckpointList,
  Cost,
  FieldValue,
  Figures,
  Finding,
  FoundingResult,
  Motion,
  OperationInfo,
  Picture,
  Shown,
  SideFile,
  Spread,
  Surface,
  SurfaceKind,
  Topology,
} from '../protocol';
import { suture } from '../notable';
import { mostKept, Recent } from '../recent';
import type { MapName } from '../view/colours';

export interface Draft {
  kind: string;
  fields: Record<string, FieldValue>;
}

export interface Choice {
  kind: 'chord' | 'head' | 'scallop' | 'orifice';
  id: string;
}

export type Panel = 'valve' | 'repair' | 'plan' | 'tour' | 'import';
export type Tool = 'look' | 'grasp' | 'push';

export const ready = signal(false);
export const broken = signal('');
export const version = signal('');
export const operations = signal<OperationInfo[]>([]);
/** The row of an operation in the library's table. */
export const operationOf = (kind: string | undefined): OperationInfo | undefined =>
  operations.value.find(({ name }) => name === kind);

/** The valve of the plan, the preview of an operation, and the moving picture that hides both. */
export const main = signal<Shown | null>(null);
export const preview = signal<Shown | null>(null);
/** The form that the preview, or its refusal, belongs to. */
export const previewed = signal<Draft | null>(null);
export const motion = signal<Motion | null>(null);
/** The moving picture is that of a valve that is being opened, and not of the valve of the plan. */
export const coming = signal(false);
/** Actions of several requests that are under way, as the opening of a file: between two requests nothing is busy. */
export const underway = signal(0);
/** Pixels that the keys of the colours take at the foot of the picture. */
export const keysHeight = signal(0);
/** mm of a pixel in the plane through the middle of what the camera looks at. */
export const perPixel = signal(0.1);
/** Picture and figures show the valve before instead of the present one. */
export const past = signal(false);
/** The first closed valve of the plan, for "before". */
export const first = signal<Shown | null>(null);

export const draft = signal<Draft | null>(null);
export const draftMessage = signal('');
/** Apply was pressed before the result of the form was shown. */
export const early = signal(false);
/** True from a change of the form until all of its preview is known, or its refusal. */
export const pending = signal(false);
export const choice = signal<Choice | null>(null);
/** Points of the outline that is being drawn on a leaflet, mm. */
export const outline = signal<number[][]>([]);
/** Where these points are: the name of a leaflet, and for each point that of a scallop. They stay beside a cut that is in the form. */
export const outlineOn = signal<{ leaflet: string; scallops: string[] }>({ leaflet: '', scallops: [] });
/** Why the last click set no point of the outline. */
export const outlineRefusal = signal('');
/** The field of the draft that the next click in the picture fills. */
export const picking = signal<string | null>(null);

/** The first visit begins with the tour. */
export const panel = signal<Panel>('tour');
export const tool = signal<Tool>('look');
/** A hand holds or pushes tissue of the living valve. */
export const handing = signal(false);
export const map = signal<MapName>('tissue');
export const openness = signal(1);
export const sectionOn = signal(false);
export const sectionAt = signal(0);
export const labelsOn = signal(true);
export const chordsOn = signal(true);
export const compareWith = signal<string | null>(null);
export const compared = signal<Shown | null>(null);

export const busy = signal<{ text: string; share: number; cancel?: () => void } | null>(null);
export const notice = signal<{
  text: string;
  /** A warning stays until it is closed. */
  kind: 'info' | 'warning' | 'error';
  /** The result code of the library behind an error. */
  code?: string;
  action?: { text: string; run: () => void };
} | null>(null);
/** The sentence of the polite status line. */
export const status = signal('');

export const checkpoints = signal<string[]>([]);
/** Hashes of the valves of the checkpoints. */
export const checkpointHashes = signal<string[]>([]);
/** Valves of kept plans by name, as they were read last. */
export const keptPlans = signal<Map<string, Shown>>(new Map());
/** The name of the checkpoint that was removed or replaced last and can be put back. */
export const removedCheckpoint = signal<string | null>(null);
export const title = signal('');
export const notes = signal('');
export const changed = signal(false);
/** The valve that the plan begins with is in no file: it was built from a surface, or recovered. */
export const onlyHere = signal(false);
/** Counts the plans that were begun: opened, built or recovered. */
export const plan = signal(0);
export const cost = signal<Cost | null>(null);
/** A view that something other than the picture asks for. */
export const wantedView = signal<{ preset: 'surgeon' | 'ventricle' } | null>(null);
/** Openings of previews and of the valves before them, by hash. */
export const openings = signal<Map<string, Cost>>(new Map());
/** ml/s through the open valve, where it is known. */
export const flow = signal<number | null>(null);
export const spread = signal<Spread | null>(null);
export const tour = signal<{ number: number; founding: FoundingResult | null } | null>(null);
/** Valves of the tour whose goals were all reached since the page was opened. */
export const finished = signal<number[]>([]);
/** A surface that a valve is to be built from, the clicked points, and the findings. */
export interface Imported {
  name: string;
  bytes: Uint8Array;
  kind: SurfaceKind;
  surface: Surface;
  points: { annulus: number[][]; commissures: number[][]; anterior: number[][]; tips: number[][] };
  closed: SideFile | null;
  /** Of the leaflets, mm. */
  thickness: number | null;
  findings: Finding[];
}
/** What the user gives beside the file. */
export type Given = 'kind' | 'points' | 'closed' | 'thickness';
export const imported = signal<Imported | null>(null);
/** The surface that is shown instead of a valve. */
export const surface = computed(() => {
  const { value } = imported;
  return value && !value.findings.length ? value : null;
});
/** Something was given beside the surface, which is kept nowhere else: clicked points, closed leaflets, a thickness. */
export const marked = computed(() => {
  const { value } = surface;
  if (!value) return false;
  return (
    !!value.closed || value.thickness !== null || Object.values(value.points).some((rows) => rows.length)
  );
});
/** Which points the next clicks on the surface set. */
export const importing = signal<keyof Imported['points']>('commissures');
/** Sections of the panels that were opened or closed by hand, by name: they stay so where a panel comes again. */
export const sections = signal<Map<string, boolean>>(new Map());
/** A file is dragged over the page. */
export const dropping = signal(false);
export const dialog = signal<'keys' | 'figures' | 'report' | 'ask' | null>(null);

/** The valve of the plan whose picture moves. */
export const resting = computed<Shown | null>(() => (coming.value ? null : main.value));

const topologies = new Recent<Topology>(mostKept);
/** Number of topologies that are kept, for the tests. */
export const keptTopologies = (): number => topologies.size;

/**
 * Keeps the connectivity that comes with a picture, and gives it to those that come without: a picture that is kept has its own.
 * Equal connectivities are one object.
 */
export function receive(picture: Picture): void {
  const known = topologies.get(picture.topology) ?? picture.connectivity;
  if (!known) return;
  topologies.set(picture.topology, known);
  picture.connectivity = known;
}

export function receiveCheckpoints(list: CheckpointList): void {
  batch(() => {
    keptPlans.value = new Map();
    checkpoints.value = list.names;
    checkpointHashes.value = list.hashes;
    removedCheckpoint.value = list.removed;
  });
}

export function topologyOf(picture: Picture): Topology | undefined {
  return picture.connectivity;
}

/** The valve before the preview, or before the whole plan. */
export const earlier = computed<Shown | null>(() => {
  if (preview.value) return main.value;
  const begin = first.value;
  return begin && begin.figures.hash !== main.value?.figures.hash ? begin : null;
});
/** The valve that one press shows in place of the present one: that of a plan that is compared, or the valve before. */
export const other = computed<Shown | null>(() => (preview.value ? null : compared.value) ?? earlier.value);
export const inPast = computed(() => past.value && !!other.value && !motion.value);
/** The valve of picture and figures: the preview if there is one, or the valve before. */
export const shown = computed<Shown | null>(() =>
  inPast.value ? other.value : (preview.value ?? main.value),
);
export const figures = computed<Figures | null>(() => (coming.value ? null : (shown.value?.figures ?? null)));
/** The spread of the valve whose figures are shown, if it was measured. */
export const shownSpread = computed(() => (spread.value?.hash === figures.value?.hash ? spread.value : null));
/** The figures to compare with. */
export const before = computed<Figures | null>(() =>
  inPast.value ? null : (earlier.value?.figures ?? null),
);
/** The chord that the preview adds; stitches of a clip or a suture do not count. */
export const added = computed(() => {
  const old = new Set(main.value?.figures.chords.map((chord) => chord.id));
  return preview.value?.figures.chords.find((chord) => chord.kind !== suture && !old.has(chord.id)) ?? null;
});
/** Whether the picture belongs to an older form than the present one, whose shape is still to come. */
export const outdated = computed(() => pending.value && previewed.value !== draft.value);
export const picture = computed<Picture | null>(() => motion.value?.picture ?? shown.value?.picture ?? null);
export const canUndo = computed(() => main.value?.figures.history.some((entry) => !entry.undone) ?? false);
export const canRedo = computed(() => main.value?.figures.history.some((entry) => entry.undone) ?? false);

/** Changes by the user of the present valve; later figures of a valve, and a preview that comes late, do not count. */
const doings = computed(() => [
  plan.value,
  main.value?.figures.hash,
  draft.value,
  picking.value,
  imported.value,
  !!motion.value,
]);
let seen: unknown[] = [];
let previewing = false;

/** Returns from the valve before to the present one where the user goes on, or where a preview leaves and “before” would be another valve. */
effect(() => {
  const gone = previewing && !preview.value;
  const { value: now } = doings;
  if (gone || now.some((value, k) => value !== seen[k])) past.value = false;
  [seen, previewing] = [now, !!preview.value];
});

/** A plan that begins shows the whole valve, and its section in the middle. */
effect(() => {
  plan.value;
  batch(() => ([sectionOn.value, sectionAt.value] = [false, 0]));
});
