// Pictures and figures of a snapshot, in the units of the page.
import { ChordKind, type Mvs, type Snapshot } from 'libmvs';
import type {
  Chord,
  Figures,
  Known,
  Measures,
  Motion,
  OrificePart,
  Part,
  Picture,
  Region,
  Topology,
} from '../protocol';
import { beyondLimit, shareOfLimit } from '../notable';
import { mostSent, Recent } from '../recent';
import { clipsOf, historyOf } from './history';
import { residualOf } from './residuals';
import { ml, mm, mm2, scaled } from './units';

/** Pa; natural chordae have less, expanded PTFE 400 MPa. */
const sutureYoung = 2e8;

const artificialOf = (snapshot: Snapshot): Uint32Array =>
  Uint32Array.from(snapshot.array<Float64Array>('chord_young'), (young) => (young >= sutureYoung ? 1 : 0));

/** Topologies that the page has. */
const sent = new Recent<true>(mostSent);

/** FNV-1a hash of words. */
function hashWords(hash: number, words: Uint32Array): number {
  for (let i = 0; i < words.length; ++i) hash = Math.imul(hash ^ words[i], 16777619);
  return hash >>> 0;
}

function partsOf(snapshot: Snapshot, kind: 'leaflet' | 'scallop' | 'chord' | 'head' | 'ring'): Part[] {
  return snapshot.parts(kind).map((part) => ({ id: String(part.id), name: part.name }));
}

function topologyKey(snapshot: Snapshot): string {
  let hash = hashWords(2166136261, snapshot.array<Uint32Array>('triangle_nodes'));
  hash = hashWords(hash, snapshot.array<Uint32Array>('chord_nodes'));
  hash = hashWords(hash, snapshot.array<Uint32Array>('chord_kind'));
  // a chord of the same name may have another thickness or material in another form
  hash = hashWords(
    hash,
    Uint32Array.from(snapshot.array<Float64Array>('chord_area'), (area) => 1e12 * area),
  );
  hash = hashWords(hash, artificialOf(snapshot));
  // two files may have the same mesh with other names, or other scallops
  hash = hashWords(hash, snapshot.array<Uint32Array>('triangle_scallop'));
  const names = ['chord', 'ring', 'head', 'leaflet', 'scallop'].flatMap((kind) =>
    partsOf(snapshot, kind as 'chord').map((p) => `${p.id}${p.name}`),
  );
  const text = new Uint32Array(
    names
      .join()
      .split('')
      .map((c) => c.charCodeAt(0)),
  );
  return `${hashWords(hash, text).toString(16)}-${snapshot.view('node_position').count}`;
}

function connectivity(snapshot: Snapshot, key: string): Topology {
  const u32 = (
    name:
      | 'triangle_nodes'
      | 'triangle_leaflet'
      | 'triangle_scallop'
      | 'annulus_nodes'
      | 'free_edge_nodes'
      | 'chord_nodes'
      | 'chord_kind'
      | 'head_nodes'
      | 'node_origin',
  ) => snapshot.copy<Uint32Array>(name);
  const radius = snapshot.copy<Float64Array>('chord_area').map((area) => Math.sqrt(area / Math.PI) * mm);
  return {
    key,
    nodes: snapshot.view('node_position').count,
    triangles: u32('triangle_nodes'),
    triangleLeaflet: u32('triangle_leaflet'),
    triangleScallop: u32('triangle_scallop'),
    annulus: u32('annulus_nodes'),
    freeEdge: u32('free_edge_nodes'),
    chordNodes: u32('chord_nodes'),
    chordKind: u32('chord_kind'),
    chordRadius: Float32Array.from(radius),
    chordArtificial: artificialOf(snapshot),
    headNodes: u32('head_nodes'),
    origin: u32('node_origin'),
    leaflets: partsOf(snapshot, 'leaflet'),
    scallops: partsOf(snapshot, 'scallop'),
    chords: partsOf(snapshot, 'chord'),
    heads: partsOf(snapshot, 'head'),
    rings: partsOf(snapshot, 'ring'),
  };
}

/** Lengths over rest lengths minus one: negative where a chord is slack. */
function chordStrains(snapshot: Snapshot): Float32Array {
  const nodes = snapshot.array<Uint32Array>('chord_nodes');
  const rest = snapshot.array<Float64Array>('chord_rest_length');
  const x = snapshot.array<Float64Array>('node_position');
  return Float32Array.from(rest, (length, k) => {
    const [a, b] = [3 * nodes[2 * k], 3 * nodes[2 * k + 1]];
    return Math.hypot(x[a] - x[b], x[a + 1] - x[b + 1], x[a + 2] - x[b + 2]) / length - 1;
  });
}

/** The picture of a snapshot; the orifice is computed only `withOrifice`. */
export function pictureOf(snapshot: Snapshot, withOrifice: boolean): Picture {
  const topology = topologyKey(snapshot);
  const picture: Picture = {
    topology,
    positions: scaled(snapshot.array<Float64Array>('node_position'), mm),
    ringPoints: scaled(snapshot.array<Float64Array>('ring_points'), mm),
    ringStart: snapshot.copy<Uint32Array>('ring_start'),
    chordTaut: chordStrains(snapshot),
    orificeVertices: withOrifice
      ? scaled(snapshot.array<Float64Array>('orifice_vertices'), mm)
      : new Float32Array(0),
    orificeTriangles: withOrifice ? snapshot.copy<Uint32Array>('orifice_triangles') : new Uint32Array(0),
  };
  if (!sent.get(topology)) {
    sent.set(topology, true);
    picture.connectivity = connectivity(snapshot, topology);
  }
  return picture;
}

export function motionOf(snapshot: Snapshot, share: number): Motion {
  return { picture: pictureOf(snapshot, false), share };
}

/** The measures known so far; the others are NaN. */
function measuresOf(snapshot: Snapshot, known: Known): Measures {
  const m =
    known === 'all'
      ? snapshot.measure()
      : known === 'orifice'
        ? snapshot.measure('orifice', 'coaptation', 'chords', 'annulus', 'crossings')
        : snapshot.measure('chords', 'annulus');
  return {
    orifice: m.regurgitant_orifice_area * mm2,
    coaptationArea: m.coaptation_area * mm2,
    coaptationMean: m.coaptation_length_mean * mm,
    coaptationMin: m.coaptation_length_min * mm,
    coaptationMax: m.coaptation_length_max * mm,
    coaptationHeight: m.coaptation_height * mm,
    coaptationDepth: m.coaptation_depth * mm,
    tentingHeight: m.tenting_height * mm,
    tentingArea: m.tenting_area * mm2,
    tentingVolume: m.tenting_volume * ml,
    billowHeight: m.billow_height * mm,
    billowVolume: m.billow_volume * ml,
    annulusAp: m.annulus_ap * mm,
    annulusCc: m.annulus_cc * mm,
    annulusPerimeter: m.annulus_perimeter * mm,
    annulusArea: m.annulus_area * mm2,
    annulusSaddle: m.annulus_saddle_height * mm,
    annulusAngle: (m.annulus_nonplanar_angle * 180) / Math.PI,
    maxChordStrain: m.max_chord_strain,
    maxChordTension: m.max_chord_tension,
    maxLeafletStrain: m.max_leaflet_strain,
    leafletStrain95: m.leaflet_strain_p95,
    leafletStress95: m.leaflet_stress_p95,
    chordsOver: 0,
    chordLoad: 0,
    crossings: m.intersections,
    atRest: m.at_rest === 1,
    underLoad: m.under_load === 1,
  };
}

function chordsOf(mvs: Mvs, snapshot: Snapshot): Chord[] {
  const artificial = artificialOf(snapshot);
  return snapshot.chords().map((chord, k) => {
    const kind = ChordKind[chord.kind];
    const limits = mvs.c.mvs_get_chord_limits(chord.kind);
    return {
      id: String(chord.id),
      name: chord.name,
      kind,
      heads: chord.heads,
      scallops: chord.scallops,
      length: chord.length * mm,
      rest: chord.rest_length * mm,
      strain: chord.strain,
      tension: chord.tension,
      strainLimit: limits.strain,
      tensionLimit: limits.tension,
      over: chord.flags !== 0,
      artificial: artificial[k] === 1,
    };
  });
}

function regionsOf(snapshot: Snapshot): Region[] {
  return snapshot.regions().map((region) => ({
    name: region.name,
    commissure: region.kind === 'commissure',
    coaptationMean: region.coaptation_length_mean * mm,
    coaptationMin: region.coaptation_length_min * mm,
    orifice: region.orifice_area * mm2,
    gap: region.gap * mm,
    billow: region.billow_height * mm,
    tenting: region.tenting_height * mm,
  }));
}

function orificePartsOf(snapshot: Snapshot): OrificePart[] {
  return snapshot.orificeParts().map((part) => ({
    area: part.area * mm2,
    gap: part.gap * mm,
    centroid: part.centroid.map((v) => v * mm) as [number, number, number],
    direction: part.direction as [number, number, number],
    anterior: part.anterior,
    posterior: part.posterior,
    commissures: part.commissures,
  }));
}

/** Largest principal stretch minus one at each node: the mean of its triangles. */
function nodeStretch(snapshot: Snapshot): Float32Array {
  const triangles = snapshot.array<Uint32Array>('triangle_nodes');
  const stretch = snapshot.array<Float64Array>('triangle_stretch');
  const nodes = snapshot.view('node_position').count;
  const sum = new Float32Array(nodes);
  const count = new Float32Array(nodes);
  for (let t = 0; t < triangles.length; ++t) {
    sum[triangles[t]] += stretch[2 * Math.floor(t / 3)] - 1;
    count[triangles[t]] += 1;
  }
  return sum.map((v, i) => (count[i] ? v / count[i] : NaN));
}

/** Rows: origin in mm, AP, CC, into the atrium. */
export function frameOf(snapshot: Snapshot): number[] {
  const frame = snapshot.frame();
  return [...frame.origin.map((v) => v * mm), ...frame.ap, ...frame.cc, ...frame.atrium];
}

export function figuresOf(mvs: Mvs, snapshot: Snapshot, known: Known = 'all'): Figures {
  const all = known === 'all';
  const chords = chordsOf(mvs, snapshot);
  const measures = measuresOf(snapshot, known);
  measures.residual = residualOf(snapshot.hash);
  measures.chordsOver = beyondLimit(chords).length;
  measures.chordLoad = Math.max(0, ...chords.map(shareOfLimit));
  const force = snapshot.array<Float64Array>('head_force');
  const heads = [];
  for (let h = 0; h < force.length; h += 3) heads.push(Math.hypot(force[h], force[h + 1], force[h + 2]));
  return {
    known,
    hash: snapshot.hash,
    valve: snapshot.name,
    measures,
    regions: all ? regionsOf(snapshot) : [],
    orificeParts: known === 'shape' ? [] : orificePartsOf(snapshot),
    chords,
    heads,
    frame: frameOf(snapshot),
    history: historyOf(snapshot),
    clips: clipsOf(mvs, snapshot),
    fields: all
      ? {
          coaptation: scaled(snapshot.array<Float64Array>('node_coaptation'), mm),
          stretch: nodeStretch(snapshot),
        }
      : null,
  };
}

/** Buffers of a result that can be transferred. */
export function buffersOf(value: unknown, found: Set<ArrayBuffer> = new Set()): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (value && typeof value === 'object') {
    for (const item of Object.values(value)) buffersOf(item, found);
  }
  return found;
}
