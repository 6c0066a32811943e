// @ts-check
// What is loaded behind the first picture, or when somebody plays, presses a key, opens a recording before it.
export { Hands } from './hands.js';
export { factsOf, marksIn } from './live/goal.js';
export { OwnGame } from './live/own/own_game.js';
export { told } from './live/words.js';
export { FineDrawing } from './picture/fine_drawing.js';
export { drawMarks } from './picture/marks.js';
export { Names } from './picture/names.js';
