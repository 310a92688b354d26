
void main() {
    shell_bits = uvec4(0u);
    golden_row(shell_sheen_table, shell_ggx_table, uint(texelFetch(shell_numbers, ivec2(0, gl_FragCoord.y), 0).x));
}
