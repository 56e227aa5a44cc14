// What the colours of the picture mean: keys of tissue and chordae; the scale of a colour map in its unit, with the limits
// of the chordae.
import { useLayoutEffect, useRef } from 'preact/hooks';
import { limitsOf, suture } from '../notable';
import * as state from '../store/state';
import { barTexts, figure, kinds, mapWords, scaleTexts } from '../text/texts';
import {
  gradient,
  isChordMap,
  maps,
  placeOf,
  type ChordMap,
  type ColourMap,
  type MapName,
} from '../view/colours';

/** Stitches are those of a suture or a clip. */
const hasStitches = (): boolean => !!state.figures.value?.chords.some((chord) => chord.kind === suture);
const hasSlack = (): boolean => !!state.picture.value?.chordTaut.some((strain) => strain < 0);
const hasArtificial = (): boolean =>
  !!state.figures.value?.chords.some((chord) => chord.artificial && chord.kind !== suture);
const hasOver = (): boolean => (state.figures.value?.measures.chordsOver ?? 0) > 0;

/** The leak of a valve at rest is drawn, whatever the colours; of one in motion it is not known. */
const showsLeak = (): boolean => !state.motion.value && (state.figures.value?.measures.orifice ?? 0) > 0;

function Key({ of, text }: { of: string; text: string }) {
  return (
    <span>
      <i class={`key key-${of}`} /> {text}
    </span>
  );
}

export function Scale() {
  const surface = !!state.surface.value;
  const name: MapName = surface ? 'tissue' : state.map.value;
  const box = useRef<HTMLDivElement>(null);
  const tissue = name === 'tissue';
  useLayoutEffect(() => {
    const size = new ResizeObserver(() => (state.keysHeight.value = box.current?.offsetHeight ?? 0));
    size.observe(box.current!);
    return () => size.disconnect();
  }, []);
  return (
    <div
      ref={box}
      class={`scale${tissue ? ' tissue' : ''}`}
      data-testid={tissue ? undefined : 'scale'}
      aria-hidden={tissue ? 'true' : undefined}
    >
      {tissue ? <TissueKeys surface={surface} /> : <MapScale name={name} />}
      <Length />
    </div>
  );
}

/** Lengths of the bar, mm, the longest first, and the most pixels of it. */
const lengths = [100, 50, 20, 10, 5, 2, 1, 0.5];
const widest = 100;

/** A bar of known length, true in the plane through the middle of what is looked at: the picture is in perspective. */
function Length() {
  const perPixel = state.perPixel.value;
  const mm = lengths.find((length) => length <= widest * perPixel) ?? lengths[lengths.length - 1];
  return (
    <span class="length" title={barTexts.lengthHelp}>
      <b data-testid="length" style={{ width: `${(mm / perPixel).toFixed(1)}px` }}>
        {barTexts.length(mm)}
      </b>
    </span>
  );
}

function TissueKeys({ surface }: { surface: boolean }) {
  return (
    <>
      <Key of="atrial" text={barTexts.atrial} />
      <Key of="ventricular" text={barTexts.ventricular} />
      {!surface && showsLeak() && <Key of="orifice" text={barTexts.leak} />}
      {!surface && hasOver() && <Key of="over" text={barTexts.over} />}
      {!surface && state.chordsOn.value && hasSlack() && <Key of="slack" text={barTexts.slack} />}
      {!surface && state.chordsOn.value && hasArtificial() && (
        <Key of="artificial" text={barTexts.artificial} />
      )}
      {!surface && state.chordsOn.value && hasStitches() && <Key of="stitch" text={barTexts.stitch} />}
    </>
  );
}

function MapScale({ name }: { name: Exclude<MapName, 'tissue'> }) {
  const map = maps[name];
  const words = mapWords[name];
  return (
    <>
      <span>{scaleTexts.title(words.scale, map.unit)}</span>
      <Bar map={map} limits={isChordMap(name) ? marksOf(name) : []} />
      {words.low && (
        <span class="bar-words">
          <em>{words.low}</em>
          <em>{words.high}</em>
        </span>
      )}
      {isChordMap(name) && <Limits name={name} />}
      {isChordMap(name) && hasOver() && <Key of="over" text={barTexts.over} />}
      {isChordMap(name) && hasSlack() && <Key of="slack" text={barTexts.slack} />}
      {isChordMap(name) && hasArtificial() && <Key of="artificial" text={barTexts.artificial} />}
      {showsLeak() && <Key of="orifice" text={barTexts.leak} />}
      {words.none && <Key of="none" text={words.none} />}
    </>
  );
}

/** Limits that are marked on the scale. */
const marksOf = (name: ChordMap): number[] =>
  name === 'load' ? [100] : limitsOf(name, state.figures.value?.chords ?? []).map(({ limit }) => limit);

function Bar({ map, limits }: { map: ColourMap; limits: number[] }) {
  const at = (value: number) => ({ left: `${100 * placeOf(map, value)}%` });
  return (
    <span class="bar">
      <i style={{ background: gradient(map) }} />
      {limits.map((limit) => (
        <b style={at(limit)} />
      ))}
      {map.ticks.map((tick) => (
        <em style={at(tick)}>{scaleTexts.tick(tick)}</em>
      ))}
    </span>
  );
}

/** The limits of the kinds of chordae, in the unit of the scale; of the share of the limit, in both units. */
function Limits({ name }: { name: ChordMap }) {
  const chords = state.figures.value?.chords ?? [];
  const sentence = (of: 'pull' | 'strain') => {
    const [most, ...others] = limitsOf(of, chords);
    const value = (limit: number) => `${figure(limit, of === 'pull' ? 0 : 1)}\u00a0${maps[of].unit}`;
    if (!most) return '';
    return scaleTexts.limit(
      value(most.limit),
      others.map((one) => [one.kinds.map((kind) => kinds[kind]).join(', '), value(one.limit)]),
    );
  };
  if (name !== 'load') return <span>{scaleTexts.limitIs(sentence(name))}</span>;
  return <span class="limits">{scaleTexts.full(sentence('pull'), sentence('strain'))}</span>;
}
