import {Color} from 'three';

/** The colours of the scene, as the style sheet's custom properties have them: one palette for page and scene. */
export interface Inks {
  readonly room: Color;
  readonly plate: Color;
  readonly grid: Color;
  readonly model: Color;
  readonly mark: Color; // what is painted on the model
  readonly glass: Color; // the model seen through
  readonly cut: Color;
  readonly cutLine: Color;
  readonly void: Color;
  readonly dense: Color;
  readonly ink: Color;
  readonly paper: Color;
  readonly accent: Color;
  readonly good: Color;
  readonly bad: Color;
  readonly mild: Color;
}

const names = ['room', 'plate', 'grid', 'model', 'mark', 'glass', 'cut', 'cut-line', 'void', 'dense', 'ink', 'paper', 'accent', 'good',
               'bad', 'mild'] as const;

export function readInks(): Inks {
  const style = getComputedStyle(document.documentElement);
  const inks: Record<string, Color> = {};
  for (const name of names) {
    const key = name.replace(/-(.)/, (_, letter: string) => letter.toUpperCase());
    inks[key] = new Color(style.getPropertyValue(`--${name}`).trim() || '#888');
  }
  return inks as unknown as Inks;
}
