import {Group, Vector3} from 'three';

import type {DocumentStore} from '../state/document';
import {type Vec3, posesOf, poseUp} from '../state/job';
import {Signal} from '../state/signal';
import {type UiStore, takesPoints} from '../state/ui';
import {type PreviewResult, type Results, type ResultsStore, freshStand, isBent, shownJudgement} from '../results/results';
import {figuresOf, shownPreview} from '../results/verdict';
import {degrees, wayOf} from '../results/words';
import {type Balance, type OnPlate, counterclockwise} from './balance';
import {FallPlayer, fallOver} from './fall';
import {Figure, type Surfaces} from './figure';
import {FindingMarks} from './finding_marks';
import {GroundMarks, barEnd} from './ground_marks';
import {type Inks, readInks} from './inks';
import {Labels} from './labels';
import {MassMark} from './mass_mark';
import {Painter} from './paint';
import {Picker} from './pick';
import {Plate} from './plate';
import {type Side, Stage} from './stage';
import {PoseMarks} from './pose_marks';

/** Keeps the scene as document, results and ways of looking have it. */
export class View {
  readonly stage: Stage;
  readonly figure = new Figure();
  readonly picker: Picker;
  readonly labels: Labels;
  readonly falling = new Group(); // what falls, or is turned by hand: the figure, and the marks in it
  readonly #plate = new Plate();
  readonly #ground = new GroundMarks();
  readonly #now = new MassMark();
  readonly #before = new MassMark();
  readonly #marks = new PoseMarks();
  readonly #painter = new Painter();
  readonly #findings: FindingMarks;
  readonly #player: FallPlayer;
  readonly #weakLabel = document.createElement('span');
  readonly #front = document.createElement('span');
  #inks: Inks = readInks();
  #seen = '';
  #isOld = true;
  #bent: Float32Array | null = null; // the positions that are shown
  #toMark: {name: string; wish: number} | null = null; // what the next picture shows for the first time
  readonly moved_mm = new Signal(0); // the largest way of a vertex in what is shown

  constructor(canvas: HTMLCanvasElement, room: HTMLElement, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, private readonly ui: UiStore, private readonly isComing: () => boolean) {
    this.stage = new Stage(canvas);
    this.stage.beforeDraw.add(() => this.#refresh()); // before what follows the figure
    this.picker = new Picker(this.stage, this.figure);
    this.labels = new Labels(this.stage, room);
    this.figure.pose.add(this.#marks.group);
    this.falling.add(this.figure.pose);
    this.stage.scene.add(this.#plate.group, this.#ground.group, this.falling, this.figure.caps, this.#now.group, this.#before.group);
    this.#findings = new FindingMarks(this.labels, this.figure, ui);
    this.#player = new FallPlayer(this.stage, this.falling, () => this.update());
    this.#weakLabel.className = 'mark weak-label';
    this.#front.className = 'mark front-label';
    this.#front.textContent = 'front';
    documents.state.subscribe(() => this.update());
    results.subscribe(() => this.update());
    ui.subscribe(() => this.update());
    this.stage.afterDraw.add(() => this.#mark());
    this.repaint();
  }

  /** Says when a picture was drawn, for who measures (User Timing). */
  #mark(): void {
    if (this.#toMark) performance.mark(this.#toMark.name, {detail: this.#toMark.wish});
    this.#toMark = null;
  }

  /** Takes the colours anew, as when light turns to dark. */
  repaint(): void {
    this.#inks = readInks();
    this.stage.paint(this.#inks);
    this.figure.paint(this.#inks);
    this.#seen = '';
    this.update();
  }

  /** Paints the job's regions again, as when a stroke was dropped. */
  paintAnew(): void {
    this.#painter.forget();
    this.update();
  }

  /** Asks for all to be brought up to date, with the next picture. */
  update(): void {
    this.#isOld = true;
    this.stage.hasModel = this.documents.doc.model !== null;
    this.stage.invalidate();
  }

  #refresh(): void {
    if (!this.#isOld) return;
    this.#isOld = false;
    const {doc} = this.documents, results = this.#drawn(), ui = this.ui.value, job = this.documents.job;
    const stand = freshStand(results, doc), fits = results.placed !== null && doc.model !== null;
    const surfaces: Surfaces | null = !fits ? null
      : stand?.outside && !this.documents.state.value.wish
        ? {outside: stand.outside, voids: stand.voids, dense: stand.dense}
        : {outside: results.placed!.mesh, voids: [], dense: null};
    const isOther = this.figure.show(surfaces);
    if (isOther && surfaces) this.#toMark = {name: 'aplomb-model-drawn', wish: 0};
    this.#bend(surfaces, isOther);
    const index = Math.min(ui.pose, posesOf(job).length - 1), pose = posesOf(job)[index]!;
    const {height} = this.#size();
    this.figure.look(ui.look);
    this.figure.stand(poseUp(pose), pose.hang ? 0.08 * height : 0);
    if (this.figure.outside) this.#painter.paint(this.figure.outside, job, index, height);
    this.#frameWhenNew(isOther);
    this.#cut();
    if (!this.#player.playing) this.#drawBalance(index);
    this.#marks.show(job, index, this.#inks, height, ui.handle);
    this.#findings.show(surfaces ? shownJudgement(results, doc)?.judgement ?? null : null);
  }

  /** What is drawn: where the result is bent and a tool takes its points from the surface, the model, of which the job speaks. */
  #drawn(): Results {
    const results = this.results.value;
    return takesPoints(this.ui.value.tool) && isBent(results, this.documents.asked) ? {...results, stand: null} : results;
  }

  #bend(surfaces: Surfaces | null, isOther: boolean): void {
    const {outside} = this.figure;
    if (!outside) return;
    const preview = surfaces?.outside === this.results.value.placed?.mesh ? this.#preview() : null;
    const positions = preview?.positions?.length === outside.positions.length ? preview.positions : null;
    if (isOther || positions !== this.#bent) {
      if (positions || this.#bent) {
        this.moved_mm.set(this.figure.bend(positions));
        this.picker.moved();
        this.#toMark = preview ? {name: 'aplomb-preview-drawn', wish: preview.preview.wish} : null;
      }
      this.#bent = positions;
    }
    if (!positions) this.moved_mm.set(0);
  }

  #preview(): PreviewResult | null {
    return shownPreview(this.#drawn(), this.documents.asked, this.isComing());
  }

  #size(): {height: number; largest: number} {
    const box = this.results.value.placed?.placed.box_mm;
    if (!box) return {height: 100, largest: 100};
    const [low, high] = box;
    return {height: high[2] - low[2], largest: Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2])};
  }

  /** Another model, placement or pose is looked at as a whole; anything else leaves the camera where it is. */
  #frameWhenNew(isOther: boolean): void {
    const {doc} = this.documents, pose = posesOf(doc.job)[this.ui.value.pose];
    const seen = JSON.stringify([doc.model?.id, this.results.value.placed?.key, pose && poseUp(pose), pose?.hang !== undefined]);
    if (!this.figure.outside || (seen === this.#seen && !isOther)) return;
    const box = this.figure.box(), model = JSON.parse(this.#seen || '[null]')[0];
    this.#plate.lay(box, this.#inks);
    if (seen !== this.#seen) this.lookFrom(model === doc.model?.id ? null : 'corner');
    this.#seen = seen;
  }

  /** Looks at all of the figure, from one side or from where one looks already. */
  lookFrom(side: Side | null): void {
    const box = this.figure.box();
    if (box.isEmpty()) return;
    box.expandByPoint(new Vector3(box.min.x, box.min.y, 0));
    this.stage.look(box, side);
  }

  #cut(): void {
    const {cutAxis, cutAt} = this.ui.value, box = this.figure.box();
    if (box.isEmpty()) return;
    const size = box.getSize(new Vector3()), center = box.getCenter(new Vector3());
    const at = box.min[cutAxis] + (0.001 + 0.998 * cutAt) * size[cutAxis];
    this.figure.section.cut(cutAxis, at, center, Math.max(size.x, size.y, size.z));
  }

  /** Plumb lines before and after, support polygon and ring of the pose that is shown. */
  #drawBalance(index: number): void {
    const inks = this.#inks, {largest} = this.#size();
    const onPlate = (p: Vec3) => new Vector3(...p).applyMatrix4(this.figure.pose.matrixWorld);
    const shown = this.figure.outside ? this.#figures(index) : null, com = shown && onPlate(shown.figures.com_mm);
    const was = shown?.pose.after ? shown.pose.before.com_mm : this.#bent ? this.results.value.placed?.placed.center_mm : null;
    this.#now.show(com, inks, largest, false);
    this.#before.show(was ? onPlate(was) : null, inks, largest, true);
    const polygon = shown?.figures.support_polygon_mm, edge = shown?.figures.weak_edge;
    if (!shown || !com || !polygon || polygon.length < 3) {
      this.#ground.show(null, inks, false);
      this.labels.remove(this.#weakLabel);
      this.labels.remove(this.#front);
      return;
    }
    const balance: Balance = {polygon: counterclockwise(polygon.map(onPlate)), com: [com.x, com.y, com.z]};
    const box = this.figure.box(), center = middleOf(balance.polygon);
    const reach = balance.polygon.map((p) => 1.25 * Math.hypot(p.x - center.x, p.y - center.y));
    const radius = Math.max(0.3 * largest, ...reach);
    this.#ground.show({
      balance, weakEdge: edge ? [onPlate(edge.from_mm), onPlate(edge.to_mm)] : null,
      askedDeg: shown.pose.required_tip_deg ?? 0, center, radius,
    }, inks, this.ui.value.ring);
    this.labels.put(this.#front, new Vector3((box.min.x + box.max.x) / 2, center.y - 1.45 * radius, 0));
    const heading = edge && new Vector3(...edge.heading).transformDirection(this.figure.pose.matrixWorld);
    if (!heading || typeof shown.figures.tip_deg !== 'number' || !this.ui.value.ring)
      return this.labels.remove(this.#weakLabel);
    this.#weakLabel.textContent = `${degrees(shown.figures.tip_deg)}°`;
    this.#weakLabel.title = `weakest ${wayOf(edge.heading, shown.pose.up)}`;
    const away = (0.16 + Math.max(barEnd(shown.figures.tip_deg), barEnd(shown.pose.required_tip_deg ?? 0))) * radius; // beyond the ring
    this.labels.put(this.#weakLabel, new Vector3(center.x, center.y, 0).addScaledVector(heading, away));
  }

  /** What is true of a pose as it is drawn now. */
  #figures(index: number): ReturnType<typeof figuresOf> {
    return figuresOf(this.#drawn(), this.documents.asked, index, this.isComing());
  }

  /** Plays the way it falls over its weak edge, of the pose that is shown. */
  fall(): void {
    const found = this.#figures(this.ui.value.pose), edge = found?.figures.weak_edge;
    if (!found || !edge || !this.figure.outside) return;
    if (this.#player.playing) return this.#player.stop();
    const turn = this.figure.pose.matrixWorld, heading = new Vector3(...edge.heading).transformDirection(turn);
    const fall = fallOver(this.figure.outside, this.figure.pose, new Vector3(...edge.from_mm).applyMatrix4(turn), heading);
    this.figure.look('solid');
    this.#now.show(null, this.#inks, 1, false);
    this.#before.show(null, this.#inks, 1, true);
    this.#player.play(fall, Math.max(0, ((found.figures.tip_deg ?? 0) * Math.PI) / 180));
  }

  get falls(): boolean {
    return this.#player.playing;
  }

  stopFall(): void {
    this.#player.stop();
  }
}

function middleOf(points: readonly OnPlate[]): OnPlate {
  const sum = points.reduce((all, p) => ({x: all.x + p.x, y: all.y + p.y}), {x: 0, y: 0});
  return {x: sum.x / points.length, y: sum.y / points.length};
}
