import { chromium } from 'playwright-core';
import { serve } from './server.js';
const [q, out, script] = process.argv.slice(2);
const { server, url } = await serve(0);
const b = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--use-vulkan=swiftshader','--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const p = await b.newPage({ viewport: { width: 1120, height: 630 } });
p.on('console', m => console.log(m.type(), m.text())); p.on('pageerror', e => console.log(String(e)));
p.on('requestfailed', r => console.log('failed', r.url())); p.on('response', r => r.status()>=400 && console.log(r.status(), r.url()));
await p.goto(url + q); await p.waitForTimeout(9000);
if (script) { await p.evaluate(script); await p.waitForTimeout(4000); }
await p.screenshot({ path: out, timeout: 60000 }); await b.close(); server.close(); process.exit(0);
