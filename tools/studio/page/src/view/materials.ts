import type {Material} from 'three';

const materials = new Map<string, Material>();

/**
 * The one material of what is drawn in this way, made when it is first asked for and never freed: WebGL's programs go with the
 * last material that uses them, and to compile one again takes longer than a whole picture. `kind` and `look` name the way.
 */
export function shared<M extends Material>(kind: string, look: readonly unknown[], make: () => M): M {
  const key = JSON.stringify([kind, look]);
  const known = materials.get(key) as M | undefined;
  if (known) return known;
  const made = make();
  materials.set(key, made);
  return made;
}
