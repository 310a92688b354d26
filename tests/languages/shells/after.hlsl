
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint count, stride;
    rows.GetDimensions(count, stride);
    if (id.x < count) {
        shell_row = rows[id.x];
        golden_row(shell_sheen_table, shell_ggx_table, shell_row.x);
    }
}
