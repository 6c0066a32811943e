// All of Asio that is not a template, compiled once (BOOST_ASIO_SEPARATE_COMPILATION) instead of in each file
// that includes it.
#include <boost/asio/impl/src.hpp>
