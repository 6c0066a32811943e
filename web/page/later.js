// @ts-check
// What is loaded when it is asked for alone: recordings, the laboratory, how far steps err.
export { Recording } from './core/recording.js';
export { Player } from './live/player.js';
export { SideBySide } from './lab/side_by_side.js';
export { ErrorFigure } from './panels/error_figure.js';
export { LabPanel } from './panels/lab_panel.js';
export { Curves } from './picture/curves.js';
