// @ts-check
// Where a room is that is at another server, as this one told it. A stranger wrote it: nothing but a host and a port is taken, and
// nobody is led there: a person is shown a link.

const LONGEST = 261;
const SHAPE = /^(?:\[[0-9A-Fa-f:.]+\]|([A-Za-z0-9][A-Za-z0-9._-]*)):([1-9][0-9]{0,4})$/;

/** The same `host:port`; '' where it is none: no link, no path, no port left out. @param {unknown} text */
export function toldAddress(text) {
  if (typeof text !== 'string' || text.length > LONGEST) return '';
  const shape = SHAPE.exec(text);
  if (!shape || Number(shape[2]) > 65535) return '';
  const name = shape[1]?.toLowerCase();
  try {
    const { hostname } = new URL(`ws://${text}`);
    return name === undefined || hostname === name ? text : '';  // 10.0.0.06 and 7 are numbers of another kind
  } catch { return ''; }
}

/** The page of that room there, by the scheme of this one: who came inside of TLS goes on inside of it.
 * @param {string} address @param {string} room @param {string} here */
export function linkTo(address, room, here) {
  const link = new URL(here);
  [link.username, link.password, link.pathname, link.hash] = ['', '', '/', ''];
  link.host = address;
  link.search = room ? new URLSearchParams({ room }).toString() : '';
  return link.href;
}

/** What ends the line, of a `moved`: with an address where that is another server's; without one this server is asked again.
 * @param {{code: string, text: string, address?: string}} message @param {string} url of the line */
export function movedTo(message, url) {
  const address = toldAddress(message.address), { code } = message;
  if (address && address.toLowerCase() !== new URL(url).host.toLowerCase()) return { code, reason: `the room is at ${address} now`, address };
  if (address || !message.address) return { code, reason: 'the room is moving' };
  return { code, reason: `the room has moved to ${JSON.stringify(message.address.slice(0, 80))}, which is no address` };
}
