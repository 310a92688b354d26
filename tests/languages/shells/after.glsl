
void main() {
    if (gl_GlobalInvocationID.x < uint(rows.length())) {
        shell_row = rows[gl_GlobalInvocationID.x];
        golden_row(shell_sheen_table, shell_ggx_table, shell_row.x);
    }
}
