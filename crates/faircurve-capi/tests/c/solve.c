/* Solves a document: solve DOCUMENT.json SAMPLES. Prints the solution as JSON. */
#include <faircurve.h>
#include <stdio.h>
#include <stdlib.h>

static char *whole(const char *name, size_t *length)
{
    FILE *file = fopen(name, "rb");
    char *text;
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    text = malloc(*length + 1);
    if (text && fread(text, 1, *length, file) != *length) {
        free(text);
        text = NULL;
    }
    fclose(file);
    return text;
}

int main(int count, char **arguments)
{
    size_t length = 0;
    char *text = count == 3 ? whole(arguments[1], &length) : NULL;
    char *message = NULL, *json = NULL;
    fc_document *document = NULL;
    fc_solution *solution = NULL;
    fc_status status;

    if (!text)
        return 2;
    status = fc_document_read_json(text, length, &document, &message);
    if (status == FC_OK)
        status = fc_solve(document, NULL, &solution, &message);
    if (status == FC_OK)
        status = fc_solution_write_json(solution, (size_t)atoi(arguments[2]), &json);
    if (status == FC_OK)
        puts(json);
    else
        fprintf(stderr, "%s\n", message ? message : fc_status_message(status));
    fc_string_free(json);
    fc_string_free(message);
    fc_solution_free(solution);
    fc_document_free(document);
    free(text);
    return status != FC_OK;
}
