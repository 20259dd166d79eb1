// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page: takes the data out of the file and puts the parts together.
import {attachKeys, Steps} from './keys.js';
import {attachPointer} from './pointer.js';
import {attachSplitter} from './splitter.js';
import {attachTooltip} from './tooltip.js';
import {candumpLine, detailPanel} from './detail.js';
import {checksTab, nodesTab} from './plain_tabs.js';
import {CountersTab} from './counters_tab.js';
import {el} from './dom.js';
import {EventsTab} from './events_tab.js';
import {FaultsTab} from './faults_tab.js';
import {FramesTab} from './frames_tab.js';
import {goToStatement, header} from './header.js';
import {idText, IdsTab} from './ids_tab.js';
import {helpDialog, legend, toolbar} from './toolbar.js';
import {keepHash, readHash} from './hash.js';
import {DbcOpener} from './open_dbc.js';
import {load, LoadError} from './load.js';
import {LoadTab} from './load_tab.js';
import {Overview} from './overview.js';
import {savePicture} from './picture.js';
import {RemoteTab} from './remote_tab.js';
import {Report} from './report.js';
import {ResponseTab} from './response_tab.js';
import {Scope} from './scope.js';
import {Chosen} from './signals.js';
import {SignalsTab} from './signals_tab.js';
import {Tabs} from './tabs.js';
import {View} from './view.js';

/** The line of candump for what is selected, on the clipboard. */
function copySelection(report, view, say) {
  const {selection} = view;
  const index =
    selection?.kind === 'frame'
      ? selection.index
      : selection?.kind === 'bit'
        ? report.segmentFrame[selection.segment]
        : -1;
  if (index < 0) return say('Select a frame first.');
  const line = candumpLine(report, report.frame(index));
  const focused = document.activeElement;
  const area = el('textarea', {}, line); // works for pages from a file, and at once
  document.body.append(area);
  area.select();
  const copied = document.execCommand('copy');
  area.remove();
  focused?.focus();
  if (!copied) return say(`Not copied, the browser does not allow it: ${line}`);
  return say(`Copied: ${line}`);
}

function sayer(host) {
  const box = el('div', {class: 'toast', role: 'status', hidden: true});
  host.append(box);
  let timer = 0;
  return (text) => {
    box.textContent = text;
    box.hidden = false;
    clearTimeout(timer);
    timer = setTimeout(() => {
      box.hidden = true;
    }, 3000);
  };
}

const partsOf = ({root, plot}) => ({root, plot});

/** The tab of the faults, if the scenario has any. */
function faultsEntry(report, view, steps) {
  if (report.faults.count === 0) return [];
  return [
    {
      id: 'faults',
      name: `Faults (${report.faults.count})`,
      title: 'Disturbances of the scenario, and when they took effect',
      root: new FaultsTab(report, view, steps).root,
    },
  ];
}

/** The tab of the remote nodes, if the scenario has any. */
function remoteEntry(report, view) {
  if (!report.remote) return [];
  const tab = new RemoteTab(report, view);
  return [
    {
      id: 'remote',
      name: 'Remote nodes',
      title: 'State and memory of the nodes without a processor at a moment',
      root: tab.root,
      shown: () => tab.show(),
    },
  ];
}

function tabsOf(report, view, steps, {frames, signals, ids}) {
  return new Tabs([
    {id: 'frames', name: 'Frames', title: 'All frames and errors; searchable', root: frames.root},
    {
      id: 'events',
      name: `Errors (${report.events.count})`,
      title: 'Errors, overloads and lost arbitrations',
      root: new EventsTab(report, view, steps).root,
    },
    {
      id: 'ids',
      name: 'Identifiers',
      title: 'How often and how regularly each identifier is on the bus',
      root: ids.root,
      shown: () => ids.fill(),
    },
    ...faultsEntry(report, view, steps),
    ...remoteEntry(report, view),
    {id: 'signals', name: 'Signals', title: 'By DBC databases', root: signals.root},
    {
      id: 'counters',
      name: 'Error counters',
      title: 'TEC, REC and state of each node over time',
      ...partsOf(new CountersTab(report, view)),
    },
    {
      id: 'load',
      name: 'Bus load',
      title: 'How busy the bus is over time',
      ...partsOf(new LoadTab(report, view)),
    },
    {
      id: 'response',
      name: 'Response times',
      title: 'From the event that queues a frame to its end',
      ...partsOf(new ResponseTab(report, view, steps)),
    },
    {id: 'nodes', name: 'Nodes', title: 'Settings and counts of each node', root: nodesTab(report)},
    {id: 'checks', name: 'Checks', title: 'What the scenario expected', root: checksTab(report)},
  ]);
}

/** Where the page opens: the address, else the report's own wish, else the whole run. */
function firstView(report, view) {
  const wanted = readHash(location.hash);
  if (wanted) {
    view.set(wanted.from, wanted.to);
    view.select(validSelection(report, wanted.selection));
  } else if (report.meta.view) {
    view.set(report.meta.view.from_ns, report.meta.view.to_ns);
  } else {
    view.set(-0.01 * report.duration, 1.01 * report.duration);
  }
}

/** The selection, unless the address names what the report does not have. */
function validSelection(report, selection) {
  const counts = {
    frame: report.frames.count,
    event: report.events.count,
    loss: report.losses.count,
    segment: report.segments.count,
  };
  if (!selection) return null;
  if (selection.kind === 'fault')
    return report.faults.span(selection.index, selection.hit) ? selection : null;
  if (selection.kind === 'bit') {
    const lane = report.lane(selection.segment, selection.lane);
    return lane && selection.bit < lane.count ? selection : null;
  }
  return selection.index < counts[selection.kind] ? selection : null;
}

function build(report, app) {
  const view = new View(report);
  const steps = new Steps(report, view);
  const help = helpDialog();
  const say = sayer(document.body);
  const frames = new FramesTab(report, view, steps);
  const actions = {
    help: () => help.showModal(),
    copy: () => copySelection(report, view, say),
    search: () => {
      tabs.show('frames');
      frames.input.focus();
    },
    tab: (id) => tabs.show(id),
    picture: (kind) => savePicture(scope, kind),
    fault: (index, hit) => steps.showFault(index, hit),
  };
  const chosen = new Chosen(report.signals);
  const opener = new DbcOpener(report.databases);
  opener.embedded(report.meta.databases ?? []);
  opener.attach(document.documentElement);
  const signals = new SignalsTab(report.signals, chosen, opener);
  const ids = new IdsTab(report, (entry) => {
    tabs.show('frames');
    frames.show(`0x${idText(entry)} ${entry.remote ? 'remote' : 'data'}`);
    steps.showFrame(entry.frames[0]);
  });
  const tabs = tabsOf(report, view, steps, {frames, signals, ids});
  const scopeHost = el('section', {class: 'scope', 'aria-label': 'Oscilloscope'});
  const overviewHost = el('div', {class: 'overview-host'});
  const bottom = el('section', {class: 'bottom'}, tabs.root, detailPanel(report, view, actions));
  app.replaceChildren(
    ...header(report, view, actions),
    toolbar(report, view, steps, actions),
    opener.alert,
    overviewHost,
    scopeHost,
    legend(),
    attachSplitter(app),
    bottom,
    help,
  );
  app.classList.toggle('app-paper', report.meta.statements.length > 0);
  const scope = new Scope(scopeHost, report, view, chosen);
  const overview = new Overview(overviewHost, report, view);
  attachPointer(scope, view);
  attachTooltip(scope, document.body);
  attachKeys(view, steps, scope, actions);
  firstView(report, view);
  keepHash(view);
  window.addEventListener('hashchange', () => firstView(report, view));
  return {
    report,
    view,
    steps,
    scope,
    overview,
    tabs,
    frames,
    chosen,
    opener,
    goToStatement,
    inspect: () => scope.inspect(),
    stats: scope.stats,
  };
}

async function start() {
  const app = document.getElementById('app');
  const bar = el('progress', {max: 1, value: 0});
  app.replaceChildren(el('p', {class: 'loading'}, 'Opening the report … ', bar));
  const begin = performance.now();
  try {
    const data = await load(document, (part) => {
      bar.value = part;
    });
    document.title = `${data.meta.title} – VeriCAN`;
    const parts = build(new Report(data), app);
    window.verican = {...parts, loadMs: performance.now() - begin};
  } catch (error) {
    const text =
      error instanceof LoadError ? error.message : `a mistake in the page: ${error.message}`;
    app.replaceChildren(
      el('p', {class: 'loading error', role: 'alert'}, `The report cannot be shown: ${text}.`),
    );
    window.verican = {error};
    if (!(error instanceof LoadError)) throw error;
  }
  document.documentElement.dataset.ready = 'yes';
}

start();
