/* Film thickness of a contact for increasing load:

       cargo build --release --manifest-path bindings/Cargo.toml --target-dir target
       cc -Ibindings/c/include bindings/c/examples/contact.c target/release/libehl_contact.so -lm -o contact
       LD_LIBRARY_PATH=target/release ./contact assets/line.rom
*/
#include <math.h>
#include <stdio.h>

#include "ehl_contact.h"

int main(int count, char **words) {
    char message[400];
    EhlInputs inputs;
    EhlOutputs outputs;
    if (count != 2) {
        fprintf(stderr, "contact MODEL.rom\n");
        return 2;
    }
    EhlContact *contact = ehl_contact_read(words[1], 0, &inputs, message, sizeof message);
    if (!contact) {
        fprintf(stderr, "%s\n", message);
        return 2;
    }
    for (int step = 0; step < 5; step++) {
        int status = ehl_contact_solve(contact, &inputs, &outputs, message, sizeof message);
        if (status == EHL_REFUSED) {
            fprintf(stderr, "%s\n", message);
            return 1;
        }
        printf("load %.3e: central film %.4e m, error below %.1e%s%s\n", inputs.load, outputs.h_c_m,
               outputs.h_c_error_bound, status == EHL_WARNING ? "; " : "", message);
        inputs.load *= 1.2;
    }
    inputs.load = NAN;
    if (ehl_contact_solve(contact, &inputs, &outputs, message, sizeof message) != EHL_REFUSED) {
        return 1;
    }
    printf("refused: %s\n", message);
    ehl_contact_free(contact);
    return 0;
}
