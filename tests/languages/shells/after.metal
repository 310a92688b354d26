
// Reads two tables, width, height and texels; then rows: a function, counts of inputs and outputs, inputs. Floats and
// unsigned integers of 32 bits, the machine's way.
template <typename T>
static bool take(T* to, size_t count) {
    return std::fread(to, sizeof(T), count, stdin) == count;
}

int main() {
    std::vector<float> texels[2];
    texture2d<float> tables[2];
    for (int k = 0; k < 2; k++) {
        uint size[2];
        if (!take(size, 2)) return 1;
        texels[k].resize(4 * size[0] * size[1]);
        if (!take(texels[k].data(), texels[k].size())) return 1;
        tables[k] = texture2d<float>{size[0], size[1], texels[k].data()};
    }
    uint row[3];
    while (take(row, 3)) {
        std::vector<float> numbers(row[1]), results(row[2]);
        if (!take(numbers.data(), row[1])) return 1;
        shell_numbers = numbers.data();
        shell_results = results.data();
        golden_row(tables[0], tables[1], row[0]);
        std::fwrite(results.data(), sizeof(float), row[2], stdout);
    }
    return 0;
}
