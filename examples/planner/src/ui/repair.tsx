// The panel "Repair": operations, the form of the operation that is being planned, and the chord or head
// that is chosen. Forms come from the library's table of operations.
import {
  ArrowUpDown,
  Circle,
  CircleDashed,
  Grip,
  Maximize2,
  Minus,
  Move,
  Paperclip,
  Scissors,
  Shapes as ShapesIcon,
  Spline,
  Square,
  Triangle,
  X,
} from 'lucide-preact';
import { edit, presentLength } from '../store/edit';
import { shownEdges } from '../store/edges';
import { insteadOfMiddle, ofMiddle } from '../store/names';
import * as state from '../store/state';
import { appTexts, figure, operationTips, repairTexts, wordsOf } from '../text/texts';
import type { FieldValue } from '../protocol';
import { ChordFacts } from './chord';
import { MadeLeak } from './earlier';
import { OperationForm } from './form';
import { Goals } from './goals';
import { Button, Section } from './parts';

const icons: Record<string, typeof Circle> = {
  ring: Circle,
  band: CircleDashed,
  annulus_scale: Maximize2,
  neochord: Spline,
  chord_add: Minus,
  chord_length: ArrowUpDown,
  chord_remove: Scissors,
  chord_transfer: Move,
  head_move: Grip,
  clip: Paperclip,
  resect: Triangle,
  patch: Square,
};
/** The order in which a surgeon looks for them; unknown operations follow. */
const order = [
  'ring',
  'band',
  'annulus_scale',
  'neochord',
  'chord_length',
  'chord_remove',
  'resect',
  'clip',
  'chord_transfer',
  'patch',
  'head_move',
  'chord_add',
];
const often = 8;

/** The first values of a form: those with which a preview says something; a chord begins with its present length. */
export function firstFields(kind: string): Record<string, FieldValue> {
  const figures = state.main.value?.figures;
  const choice = state.choice.value;
  const chord = choice?.kind === 'chord' ? figures?.chords.find((item) => item.id === choice.id) : undefined;
  if (kind === 'ring')
    return { size: Math.min(40, Math.max(24, 2 * Math.round((figures?.measures.annulusCc ?? 34) / 2))) };
  const parts = insteadOfMiddle();
  if (parts && kind === 'clip') return parts;
  if (parts && kind === 'resect') return { scallop: parts.posterior };
  if (kind === 'band') return { factor: 0.9 };
  if (kind === 'annulus_scale') return { factor: 0.95 };
  if (kind === 'chord_length') return chord ? { chord: chord.id, length: presentLength(chord.id) } : {};
  if (kind === 'chord_remove' || kind === 'chord_transfer') return chord ? { chord: chord.id } : {};
  if (kind === 'head_move')
    return choice?.kind === 'head'
      ? { head: choice.id, by: [0, 0, 0], frame: 1 }
      : { by: [0, 0, 0], frame: 1 };
  return {};
}

/** The clip that joins a scallop to the one that lies opposite; null where there is none. */
function clipFields(name: string): Record<string, FieldValue> | null {
  const scallops = state.topologyOf(state.main.value!.picture)?.scallops ?? [];
  const [anterior, posterior] = ['A', 'P'].map((leaflet) =>
    scallops.find((part) => /^[AP]\d$/.test(name) && part.name === leaflet + name[1]),
  );
  return anterior && posterior ? { anterior: anterior.id, posterior: posterior.id } : null;
}

/** The field that the first click in the picture fills. */
export function firstPick(kind: string, fields: Record<string, FieldValue>): string | null {
  const info = state.operationOf(kind);
  const asks =
    info?.fields.filter(
      (field) => ['chord', 'site', 'head'].includes(field.type) && fields[field.name] === undefined,
    ) ?? [];
  const site = asks.find((field) => field.type === 'site' && field.required);
  return (site ?? asks.find((field) => field.required))?.name ?? (kind === 'chord_transfer' ? 'site' : null);
}

export function begin(kind: string): void {
  const fields = firstFields(kind);
  const info = state.operationOf(kind);
  // a chord that the operation is not about is let go
  if (state.choice.value?.kind === 'chord' && !info?.fields.some((field) => field.type === 'chord'))
    state.choice.value = null;
  edit(kind, fields);
  state.picking.value = firstPick(kind, fields);
}

export function RepairPanel() {
  const draft = state.draft.value;
  const known = state.operations.value;
  if (!state.main.value) return <p class="hint">{appTexts.closing}</p>;
  if (draft) return <OperationForm key={draft.kind} />;
  const sorted = [...known].sort((a, b) => rank(a.name) - rank(b.name));
  const cards = (from: number, to: number) =>
    sorted.slice(from, to).map((operation) => {
      const Icon = icons[operation.name] ?? ShapesIcon;
      const words = wordsOf(operation.name, operation.help);
      return (
        <button
          type="button"
          class="card"
          title={operationTips[operation.name] ?? words.short}
          onClick={() => begin(operation.name)}
          data-operation={operation.name}
        >
          <Icon size={22} aria-hidden="true" />
          <span>
            <strong>{words.title}</strong>
            <small>{ofMiddle(words.short)}</small>
          </span>
        </button>
      );
    });
  return (
    <div class="panel-body">
      {state.tour.value && <Goals number={state.tour.value.number} short />}
      <MadeLeak />
      <Chosen />
      <div class="cards">{cards(0, often)}</div>
      <Section title={repairTexts.more}>
        <div class="cards">{cards(often, sorted.length)}</div>
      </Section>
    </div>
  );
}

function rank(name: string): number {
  const k = order.indexOf(name);
  return k < 0 ? order.length : k;
}

function LetGo() {
  return (
    <Button
      kind="quiet"
      icon={<X size={16} />}
      label={repairTexts.letGo}
      keys="Escape"
      onClick={() => (state.choice.value = null)}
    />
  );
}

function Chosen() {
  const choice = state.choice.value;
  const figures = state.main.value?.figures;
  if (!choice || !figures) return <p class="hint">{repairTexts.hint}</p>;
  if (choice.kind === 'chord') {
    const chord = figures.chords.find((item) => item.id === choice.id);
    if (!chord) return null;
    return (
      <div class="chosen-card" data-testid="chosen">
        <LetGo />
        <ChordFacts chord={chord} />
        <div class="row">
          <Button kind="main" icon={<ArrowUpDown size={16} />} onClick={() => begin('chord_length')}>
            {repairTexts.changeLength}
          </Button>
          <Button icon={<Scissors size={16} />} onClick={() => begin('chord_remove')}>
            {repairTexts.cut}
          </Button>
          <Button icon={<Move size={16} />} onClick={() => begin('chord_transfer')}>
            {repairTexts.transfer}
          </Button>
        </div>
        <p class="hint">{repairTexts.drag}</p>
      </div>
    );
  }
  if (choice.kind === 'head') {
    const topology = state.topologyOf(state.main.value!.picture);
    const h = topology?.heads.findIndex((part) => part.id === choice.id) ?? -1;
    if (h < 0) return null;
    return (
      <div class="chosen-card" data-testid="chosen">
        <LetGo />
        <h3>{repairTexts.head(topology!.heads[h].name)}</h3>
        <dl>
          <dt>{repairTexts.pullOfChordae}</dt>
          <dd>{figure(figures.heads[h], 2)} N</dd>
        </dl>
        <div class="row">
          <Button
            icon={<Spline size={16} />}
            onClick={() => (edit('neochord', { head: choice.id }), (state.picking.value = 'site'))}
          >
            {repairTexts.neochordFrom}
          </Button>
          <Button icon={<Grip size={16} />} onClick={() => begin('head_move')}>
            {repairTexts.move}
          </Button>
        </div>
      </div>
    );
  }
  const topology = state.topologyOf(state.main.value!.picture);
  const part = topology?.scallops.find((item) => item.id === choice.id);
  const region = figures.regions.find((item) => item.name === part?.name);
  if (!part || !region) return null;
  const edge = shownEdges.value.get(part.name);
  const opposite = clipFields(part.name);
  return (
    <div class="chosen-card" data-testid="chosen">
      <LetGo />
      <h3>{repairTexts.scallop(part.name)}</h3>
      <dl>
        <dt>{repairTexts.coaptation}</dt>
        <dd>{figure(region.coaptationMean)} mm</dd>
        <dt>{repairTexts.leak}</dt>
        <dd>{region.orifice > 0 ? `${figure(region.orifice)} mm²` : repairTexts.none}</dd>
        <dt>{repairTexts.billow}</dt>
        <dd>{region.billow > 0 ? `${figure(region.billow)} mm` : repairTexts.none}</dd>
        {edge !== undefined && (
          <>
            <dt>{repairTexts.edge}</dt>
            <dd>{repairTexts.edgeAt(edge)}</dd>
          </>
        )}
      </dl>
      <div class="row">
        <Button icon={<Spline size={16} />} onClick={() => begin('neochord')}>
          {repairTexts.neochord}
        </Button>
        <Button icon={<Triangle size={16} />} onClick={() => edit('resect', { scallop: choice.id })}>
          {repairTexts.resect}
        </Button>
        {opposite && (
          <Button icon={<Paperclip size={16} />} onClick={() => edit('clip', opposite)}>
            {repairTexts.clip}
          </Button>
        )}
      </div>
    </div>
  );
}
