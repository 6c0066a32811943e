// A server that was built without the page.
#include "server/web/page_files.h"

namespace woodlouse::server {

EmbeddedPage embedded_page() { return {}; }

}  // namespace woodlouse::server
