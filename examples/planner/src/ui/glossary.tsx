// The dialog "What the figures mean": each figure in a surgeon's words with its unit and how it is measured, and a sketch of the
// scallops in the surgeon's view.
import { figureHelp } from '../text/texts';
import { Modal } from './modal';

/** Names of the scallops and their places in the sketch. */
const places: [string, number, number][] = [
  ['A1', 44, 48],
  ['A2', 100, 42],
  ['A3', 156, 48],
  ['P1', 47, 97],
  ['P2', 100, 118],
  ['P3', 153, 97],
];

/** Annulus, line of closure, and the borders of the scallops. */
const annulus = 'M18 64C18 30 58 14 100 14S182 30 182 64C182 104 142 140 100 140S18 104 18 64Z';
const closure = 'M18 64C44 70 60 96 100 96S156 70 182 64';
const borders = ['M66 20L68 87', 'M134 20L132 87', 'M70 88L56 125', 'M130 88L144 125'];

export function Sketch() {
  const [left, right] = figureHelp.sides;
  return (
    <svg class="sketch" viewBox="-14 0 228 154" role="img" aria-label={figureHelp.sketch}>
      <path d={annulus} class="sketch-annulus" />
      <path d={closure} class="sketch-closure" />
      {borders.map((d) => (
        <path d={d} class="sketch-border" />
      ))}
      {places.map(([name, x, y]) => (
        <text x={x} y={y} class="sketch-name">
          {name}
        </text>
      ))}
      <text x="0" y="68">
        {left}
      </text>
      <text x="200" y="68">
        {right}
      </text>
      <text x="100" y="9">
        {figureHelp.front}
      </text>
      <text x="100" y="152">
        {figureHelp.back}
      </text>
    </svg>
  );
}

export function FigureHelp() {
  return (
    <Modal title={figureHelp.title} wide reading>
      <div class="figure-help" data-testid="figure-help">
        <section class="sketched">
          <Sketch />
          <div>
            {figureHelp.scallops.map((line) => (
              <p>{line}</p>
            ))}
            <p>{figureHelp.intro}</p>
          </div>
        </section>
        {figureHelp.groups.map(({ title, figures }) => (
          <section>
            <h3>{title}</h3>
            <dl>
              {figures.map(({ names, unit, meaning, measured }) => (
                <div>
                  <dt>
                    {names.map((name) => (
                      <span>{name}</span>
                    ))}
                  </dt>
                  <dd>
                    {meaning}{' '}
                    <small>
                      {figureHelp.unit}: {unit}. {figureHelp.measured}: {measured}
                    </small>
                  </dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </Modal>
  );
}
