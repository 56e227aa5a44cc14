// Bringing in a patient's surface: unit, points that the surgeon knows, building, and the findings.
import { Hammer, Undo2, X } from 'lucide-preact';
import { buildValve, chooseUnit } from '../store/files';
import * as state from '../store/state';
import type { FileUnit, Finding, SurfaceKind } from '../protocol';
import { fileUnits, millimetres } from '../units';
import { importTexts, say, tips } from '../text/texts';
import { Known } from './import_known';
import { Button } from './parts';

const kinds = ['commissures', 'anterior', 'annulus', 'tips'] as const;

export function ImportPanel() {
  const imported = state.imported.value;
  if (!imported) return <p class="hint">{importTexts.none}</p>;
  if (imported.findings.length) return <Findings />;
  const { surface } = imported;
  /** Leaves all points of a kind up to one, as `slice` counts. */
  const keep = (kind: (typeof kinds)[number], end: number) =>
    (state.imported.value = {
      ...imported,
      points: { ...imported.points, [kind]: imported.points[kind].slice(0, end) },
    });
  return (
    <div class="panel-body">
      <h2>{imported.name}</h2>
      <p>{importTexts.intro}</p>
      <div class="field">
        <label for="unit">{importTexts.unit}</label>
        <select
          id="unit"
          title={tips[importTexts.unit]}
          value={surface.unit}
          disabled={surface.unitFrom === 'file'}
          onChange={(event) => void chooseUnit(event.currentTarget.value as FileUnit)}
        >
          {fileUnits.map((unit) => (
            <option value={unit}>
              {importTexts.unitOption(
                unit,
                (Math.max(...surface.size) * millimetres[unit]) / millimetres[surface.unit],
              )}
            </option>
          ))}
        </select>
        <small>
          {importTexts.size(surface.size)} {importTexts.unitFrom[surface.unitFrom]}
        </small>
      </div>
      <div class="field">
        <label for="surface-kind">{importTexts.kind}</label>
        <select
          id="surface-kind"
          title={tips[importTexts.kind]}
          value={imported.kind}
          onChange={(event) =>
            (state.imported.value = { ...imported, kind: event.currentTarget.value as SurfaceKind })
          }
        >
          {Object.entries(importTexts.kinds).map(([kind, words]) => (
            <option value={kind}>{words}</option>
          ))}
        </select>
      </div>
      {kinds.map((kind) => (
        <div class="row points">
          <Button
            icon={<i class={`key key-point-${kind}`} />}
            pressed={state.importing.value === kind}
            onClick={() => (state.importing.value = kind)}
          >
            {importTexts.points[kind]}
          </Button>
          <span class="hint">
            {imported.points[kind].length
              ? importTexts.set(imported.points[kind].length)
              : importTexts.guessed}
          </span>
          {/* always there, so that nothing moves under the pointer */}
          <Button
            kind="quiet"
            icon={<Undo2 size={16} />}
            label={importTexts.undo(importTexts.of[kind])}
            title={importTexts.undoTip}
            disabled={!imported.points[kind].length}
            onClick={() => keep(kind, -1)}
          />
          <Button
            kind="quiet"
            icon={<X size={16} />}
            label={importTexts.clear(importTexts.of[kind])}
            title={importTexts.clearTip}
            disabled={!imported.points[kind].length}
            onClick={() => keep(kind, 0)}
          />
        </div>
      ))}
      <p class="hint">{importTexts.tips}</p>
      <Known imported={imported} />
      <div class="form-foot">
        <button
          type="button"
          class="button main"
          title={tips[importTexts.build]}
          onClick={() => void buildValve()}
        >
          <Hammer size={16} />
          <span>{importTexts.build}</span>
        </button>
        <Button onClick={() => ((state.imported.value = null), (state.panel.value = 'valve'))}>
          {importTexts.leave}
        </Button>
      </div>
    </div>
  );
}

/** Confidence below which a finding is to be looked at, also where it was given. */
const sure = 0.7;

const ofLeak = /^leak(_interval|_at_rest)?$/;
const ofMesh = /^(surface|mesh|crossings|\w*holes|cut_handles|pinched_gaps|leak_limits)$/;

/** The findings by what is to be done about them, the least certain first; what was done to the mesh last. */
function groupsOf(findings: Finding[]): [string, Finding[]][] {
  const leak = findings.filter(({ name }) => ofLeak.test(name));
  const mesh = findings.filter(({ name }) => ofMesh.test(name));
  const others = findings
    .filter((one) => !leak.includes(one) && !mesh.includes(one))
    .sort((a, b) => a.confidence - b.confidence);
  const { groups } = importTexts;
  return [
    [groups.leak, leak],
    [groups.unsure, others.filter(({ confidence }) => confidence < sure)],
    [groups.sure, others.filter(({ confidence }) => confidence >= sure)],
    [groups.mesh, mesh],
  ];
}

function Row({ finding }: { finding: Finding }) {
  const doubtful = finding.confidence < sure && !ofLeak.test(finding.name);
  return (
    <li class={doubtful ? 'doubtful' : undefined}>
      <strong>{finding.name.replace(/_/g, ' ')}</strong>{' '}
      <span class="tag">{importTexts.sources[finding.source]}</span>
      <p>{say(finding.sentence)}</p>
    </li>
  );
}

function Findings() {
  const imported = state.imported.value!;
  const { findings, name } = imported;
  return (
    <div class="panel-body">
      <h2>{importTexts.found}</h2>
      <p class="hint">{name}</p>
      <div data-testid="findings">
        {groupsOf(findings).map(
          ([title, group]) =>
            group.length > 0 && (
              <>
                <h3>{title}</h3>
                <ul class="findings">
                  {group.map((finding) => (
                    <Row finding={finding} />
                  ))}
                </ul>
              </>
            ),
        )}
      </div>
      <div class="form-foot">
        <Button onClick={() => (state.imported.value = { ...imported, findings: [] })}>
          {importTexts.again}
        </Button>
      </div>
    </div>
  );
}
