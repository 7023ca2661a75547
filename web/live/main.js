// The live view's page.
import { cloudOf, colorOfLabel, describe, jpegOf, kindOf } from './messages.js';
import { World } from './world.js';

const element = (id) => document.getElementById(id);

function makeWorld() {
  const canvas = element('world');
  try {
    const world = new World(canvas);
    new ResizeObserver(() => world.resize(canvas.clientWidth, canvas.clientHeight)).observe(canvas);
    return world;
  } catch (error) {
    element('no-world').hidden = false;
    canvas.hidden = true;
    console.warn(`no 3-D view: ${error.message}`);
    return null;
  }
}

function showState(state) {
  element('status').textContent = state.status;
  element('status').className = state.has_pose ? 'good' : 'bad';
  const table = element('numbers');
  table.replaceChildren(...describe(state).flatMap(([name, text]) => {
    const term = document.createElement('dt'), value = document.createElement('dd');
    term.textContent = name;
    value.textContent = text;
    return [term, value];
  }));
  element('progress').hidden = !state.frames;
  if (state.frames) element('progress').value = state.frames_done / state.frames;
}

let shown = null;
function showPicture(jpeg) {
  const url = URL.createObjectURL(jpeg);
  element('picture').src = url;
  if (shown) URL.revokeObjectURL(shown);
  shown = url;
}

let names = [];
const seen = new Set();
/** The labels that the clouds show, as a legend. */
function noteLabels(labels) {
  const before = seen.size;
  for (const label of labels) if (label !== 255) seen.add(label);
  if (seen.size === before) return;
  element('legend').replaceChildren(...[...seen].sort((a, b) => a - b).map((label) => {
    const item = document.createElement('li');
    item.textContent = names[label] ?? `class ${label}`;
    item.style.setProperty('--color', `rgb(${colorOfLabel(label).join()})`);
    return item;
  }));
}

function listen(world) {
  const socket = new WebSocket(`ws://${location.host}/stream`);
  socket.binaryType = 'arraybuffer';
  let ended = false;
  const say = (text) => { element('connection').textContent = text; };
  socket.onopen = () => say('live');
  socket.onclose = () => say(ended ? 'the run has ended' : 'the program is gone; reload to try again');
  const tell = {
    state: (message) => { showState(message); world?.setCamera(message.world_from_camera); },
    keyframes: (message) => world?.setKeyframes(message.poses),
    classes: (message) => { names = message.names; },
    end: () => { ended = true; },
  };
  socket.onmessage = ({ data }) => {
    if (typeof data === 'string') {
      const message = JSON.parse(data);
      tell[message.kind]?.(message);
    } else if (kindOf(data) === 'I') {
      showPicture(jpegOf(data));
    } else if (kindOf(data) === 'C') {
      const cloud = cloudOf(data);
      noteLabels(cloud.labels);
      world?.addCloud(cloud);
    }
  };
}

const world = makeWorld();
element('by-label').addEventListener('change', ({ target }) => world?.showLabels(target.checked));
element('follow').addEventListener('change', ({ target }) => { if (world) world.follows = target.checked; });
listen(world);
