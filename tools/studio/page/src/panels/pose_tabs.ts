import {type Bench, tenth} from '../tools/tool';
import {type Pose, type Vec3, edited, poseName, posesOf, vectorOf, withHang, withPose, withStand} from '../state/job';
import {verdictOf} from '../results/verdict';
import {type Kept, h, icon, keeper, newId, say} from './dom';
import {type Part, choiceField, numberField, paired, shownIn} from './fields';
import {icons} from './icons';

const ways: readonly (readonly [string, string])[] = [
  ['', 'as it is placed'], ['-z', 'upside down'], ['x', 'its right side up (+x)'], ['-x', 'its left side up (−x)'],
  ['y', 'its back up (+y)'], ['-y', 'its front up (−y)'],
];

/** The poses as tabs, and what is asked of the one that is open. */
export function posePanel(bench: Bench): Part {
  const {documents, ui} = bench;
  const tabs = h('div', {class: 'tab-list', role: 'tablist', 'aria-label': 'Poses', onkeydown: (event: KeyboardEvent) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0, all = posesOf(documents.doc.job).length;
    if (!step) return;
    const pose = (ui.value.pose + step + all) % all;
    ui.patch({pose});
    (tabs.children[pose] as HTMLElement | undefined)?.focus();
    event.preventDefault();
  }});
  const bodyId = newId(), keepTabs = keeper(tabs, (index) => tab(bench, index, bodyId));
  const current = (): Pose => posesOf(documents.doc.job)[ui.value.pose] ?? {stand: {}};
  const change = (pose: Pose, label: string) =>
    documents.change(withPose({...documents.doc.job, poses: posesOf(documents.doc.job)}, ui.value.pose, pose), label);
  const name = h('input', {class: 'pose-name', maxLength: 200, 'aria-label': 'Name of the pose', onchange: () =>
    change(edited(current(), {name: name.value || undefined}), 'pose name')});
  const showName = shownIn(name), fields = poseFields(bench, current, change);
  const remove = h('button', {class: 'quiet', title: 'Take this pose away', onclick: () => {
    const rest = posesOf(documents.doc.job).filter((_, at) => at !== ui.value.pose);
    documents.change(edited(documents.doc.job, {poses: rest}), 'remove a pose');
    ui.patch({pose: 0});
  }}, 'Remove');
  const body = h('div', {class: 'pose-body', role: 'tabpanel', id: bodyId},
                 h('div', {class: 'pose-head'}, name, remove), ...fields.map((field) => field.element));
  const add = adder(bench), element = h('section', {class: 'poses'}, h('div', {class: 'tabs'}, tabs, add), body);
  const update = () => {
    const {job} = documents.doc, poses = posesOf(job), at = Math.min(ui.value.pose, poses.length - 1);
    if (at !== ui.value.pose) ui.patch({pose: at});
    keepTabs(poses.length);
    body.setAttribute('aria-labelledby', tabs.children[at]!.id);
    say(add.lastElementChild as HTMLElement, poses.length > 1 ? '' : 'Add a pose');
    showName(poseName(current(), at));
    remove.hidden = poses.length < 2;
    body.querySelector('.pose-head')!.toggleAttribute('hidden', poses.length < 2);
    fields.forEach((field) => field.update());
  };
  return {element, update};
}

function tab(bench: Bench, index: number, panel: string): Kept {
  const {documents, results, ui, conductor} = bench, picture = h('span', {class: 'tab-picture'}), name = h('span', {});
  const element = h('button', {role: 'tab', class: 'tab', id: newId(), 'aria-controls': panel, onclick: () => ui.patch({pose: index})}, picture, name);
  const update = () => {
    const poses = posesOf(documents.doc.job), verdict = verdictOf(results.value, documents.asked, index, conductor.answering);
    const isOpen = index === Math.min(ui.value.pose, poses.length - 1);
    element.setAttribute('aria-selected', String(isOpen));
    element.tabIndex = isOpen ? 0 : -1;
    element.title = verdict.line;
    if (element.dataset.tone !== verdict.tone) picture.replaceChildren(icon(icons[verdict.tone === 'none' ? 'wait' : verdict.tone]));
    element.dataset.tone = verdict.tone;
    say(name, poseName(poses[index]!, index));
  };
  return {element, update};
}

function adder(bench: Bench): HTMLElement {
  return h('button', {class: 'tab add', title: 'Add a pose that must hold, too', 'aria-label': 'Add a pose', onclick: () => {
    const {documents, ui} = bench, poses = posesOf(documents.doc.job);
    documents.change({...documents.doc.job, poses: [...poses, {stand: {up: '-z'}}]}, 'add a pose');
    ui.patch({pose: poses.length});
  }}, icon(icons.plus), h('span', {}));
}

function poseFields(bench: Bench, current: () => Pose, change: (pose: Pose, label: string) => void): Part[] {
  const {documents, ui} = bench;
  const own = () => current().stand?.up ?? current().hang?.up;
  const kind = choiceField({
    label: 'This pose', options: () => [['stand', 'stands'], ['hang', 'hangs']], value: () => (current().hang ? 'hang' : 'stand'),
    change: (value) => {
      const {name} = current(), up = own(), top = bench.view.figure.outside?.farthest(vectorOf(up)) ?? [0, 0, 0];
      const from_mm = [top.map(tenth) as unknown as Vec3];
      const pose: Pose = value === 'hang' ? {name, hang: edited({from_mm, up}, {})} : {name, stand: edited({up}, {})};
      change(edited(pose, {}), 'pose');
    },
  });
  const asked = numberField({
    label: 'Asked', unit: '°', min: 0, max: 89, step: 1, standard: () => (current().hang ? '2' : '10'),
    hint: 'Standing: the tilt of the table that it must bear. Hanging: how level.',
    value: () => current().stand?.tip_deg ?? current().hang?.tilt_deg,
    change: (value) => {
      const job = {...documents.doc.job, poses: posesOf(documents.doc.job)}, at = ui.value.pose;
      documents.change(current().hang ? withHang(job, at, {tilt_deg: value}) : withStand(job, at, {tip_deg: value}), 'angle');
    },
  });
  const up = choiceField({
    label: 'Way up', value: () => (own() === undefined ? '' : typeof own() === 'string' ? String(own()) : 'own'),
    options: () => (Array.isArray(own()) ? [...ways, ['own', `(${vectorOf(own()).map((v) => v.toFixed(2)).join(', ')})`]] : ways),
    change: (value) => {
      if (value === 'own') return;
      const fields = {up: value === '' ? undefined : (value as '-z')}, pose = current();
      change(edited(pose, {stand: pose.stand && edited(pose.stand, fields), hang: pose.hang && edited(pose.hang, fields)}), 'way up');
    },
  });
  const text = h('span', {}), clear = h('button', {class: 'quiet', onclick: () =>
    documents.change(withStand(documents.doc.job, ui.value.pose, {contacts: undefined}), 'touch anywhere')}, 'Anywhere');
  const touches: Part = {
    element: h('div', {class: 'field'}, h('span', {class: 'label'}, 'Touches'), h('span', {class: 'row'}, text, clear)),
    update: () => {
      const contacts = current().stand?.contacts?.length ?? 0;
      touches.element.hidden = current().hang !== undefined;
      text.textContent = contacts ? `${contacts} ${contacts === 1 ? 'place' : 'places'}` : 'anywhere';
      clear.hidden = contacts === 0;
    },
  };
  return [paired(kind, asked), up, touches];
}
