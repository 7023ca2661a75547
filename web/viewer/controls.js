// The switches beside the view.

function add(parent, tag, attributes = {}, text = '') {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.textContent = text;
  parent.append(element);
  return element;
}

function addInput(parent, type, name, text, checked, onChange) {
  const label = add(parent, 'label');
  const input = add(label, 'input', { type, name });
  input.checked = checked;
  input.addEventListener('change', () => onChange(input.checked));
  label.append(` ${text}`);
  return input;
}

function addGroup(parent, legend) {
  const group = add(parent, 'fieldset');
  add(group, 'legend', {}, legend);
  return group;
}

/**
 * Fills `parent` with the switches for `state`; `onChange` is called after each change of it.
 * `available` has the names of the layers that there are; `runs` the names of the runs.
 */
export function makeControls(parent, state, available, runs, onChange, onReset) {
  const set = (change) => { change(); onChange(); };
  if (runs.length > 1) {
    const group = addGroup(parent, 'Run');
    runs.forEach((name, i) =>
      addInput(group, 'radio', 'run', name, i === state.run, () => set(() => { state.run = i; })));
  }
  const layers = addGroup(parent, 'Show');
  const titles = { cloud: 'point cloud', voxels: 'octree', trajectory: 'trajectory', truth: 'ground truth' };
  for (const name of available) {
    addInput(layers, 'checkbox', name, titles[name], state.show[name],
      (on) => set(() => { state.show[name] = on; }));
  }
  const colors = addGroup(parent, 'Colour by');
  for (const kind of ['appearance', 'label']) {
    addInput(colors, 'radio', 'color', kind, kind === state.color, () => set(() => { state.color = kind; }));
  }
  const reset = add(parent, 'button', { type: 'button' }, 'Reset view');
  reset.addEventListener('click', onReset);
}
