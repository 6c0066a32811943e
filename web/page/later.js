// @ts-check
// What is loaded when it is asked for alone: recordings and the laboratory.
export { Recording } from './core/recording.js';
export { Player } from './live/player.js';
export { SideBySide } from './lab/side_by_side.js';
export { LabPanel } from './panels/lab_panel.js';
export { Curves } from './picture/curves.js';
