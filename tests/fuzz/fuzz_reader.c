/* Any bytes whatever into the reader: it must neither crash nor hang, and what it takes must come
 * back the same when it is written, as text and through blocks, and read again. */
#include "copy.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    begin_files();
    if (!comes_back((const char *)bytes, n))
        abort();
    end_files();
    return 0;
}
