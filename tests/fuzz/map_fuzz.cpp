// libFuzzer target of the photon map file.
#include "fuzz/feed.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    lw::test::feed_map({bytes, size});
    return 0;
}
